/** Mode shapes and equilibria of a file. The largest component of a shape is one. */
class Shapes {
  constructor(data, modes) {
    Object.assign(this, { nodes: data.nodes, geometry: data.geometry, modes, n: data.coordinates });
    this.numbers = int16(data.shapes);
    this.equilibrium = float32(data.equilibrium);
  }

  complex(row, mode, i) {
    const at = 2 * ((row * this.modes + mode) * this.n + i);
    return [this.numbers[at] / 32767, this.numbers[at + 1] / 32767];
  }
  component(row, mode, i, phase) {
    const [re, im] = this.complex(row, mode, i);
    return re * Math.cos(phase) - im * Math.sin(phase);
  }
  exists(row, mode) {
    for (let i = 0; i < this.n; ++i) if (this.complex(row, mode, i).some((part) => part !== 0)) return true;
    return false;
  }
  nearest(path, place) { return leastOf([...this.nodes.keys()], (row) => Math.abs(path.places[this.nodes[row]] - place)); }

  /** Positions of origins, axes and places, displaced by the mode with this amplitude and phase. */
  positions(row, mode, amplitude, phase) {
    const x = (i) => this.equilibrium[row * this.n + i] + amplitude * this.component(row, mode, i, phase);
    const triple = (i) => [x(i), x(i + 1), x(i + 2)];
    const { carriers, places } = this.geometry;
    const origins = carriers.map((carrier) => triple(carrier.first));
    const axes = carriers.map((carrier) => (carrier.body ? [3, 6, 9].map((k) => triple(carrier.first + k)) : []));
    const at = places.map(({ carrier, at: all }) => {
      const local = all[Math.min(row, all.length - 1)];
      if (carrier === null) return local;
      return axes[carrier].reduce((sum, axis, k) => sum.map((value, j) => value + local[k] * axis[j]), origins[carrier]);
    });
    return { origins, axes, places: at };
  }

  /** Centre and radius of the figure at rest, and the amplitude with which the largest displacement is 0.3 radii. */
  figure(row, mode) {
    if (this.cached && this.cached.row === row && this.cached.mode === mode) return this.cached;
    const rest = this.positions(row, mode, 0, 0), all = [...rest.origins, ...rest.places];
    const low = [0, 1, 2].map((k) => Math.min(...all.map((p) => p[k]))), high = [0, 1, 2].map((k) => Math.max(...all.map((p) => p[k])));
    const radius = Math.max(Math.hypot(...high.map((h, k) => h - low[k])) / 2, 1e-9) || 1;
    let largest = 0;
    const wide = radius > 1e-8 ? radius : 1;
    for (const phase of [0, Math.PI / 4, Math.PI / 2, (3 * Math.PI) / 4]) {
      const moved = this.positions(row, mode, 1, phase);
      for (const part of ["origins", "places"])
        moved[part].forEach((p, i) => { largest = Math.max(largest, Math.hypot(...p.map((value, k) => value - rest[part][i][k]))); });
    }
    const displacement = largest > 0 ? (0.3 * wide) / largest : 0, extremes = [...all];
    for (let i = 0; i < 8; ++i) {
      const moved = this.positions(row, mode, displacement, (i * Math.PI) / 4);
      extremes.push(...moved.origins, ...moved.places);
    }
    this.cached = { row, mode, rest, centre: low.map((l, k) => (l + high[k]) / 2), radius: wide, displacement, extremes };
    return this.cached;
  }
}
