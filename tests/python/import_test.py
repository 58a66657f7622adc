"""What `import eigentrail` imports, and when Datasets have their accessor."""

import subprocess
import sys
import unittest

SLOW = ("xarray", "pandas", "scipy", "h5py", "matplotlib", "plotly", "tqdm")  # each takes longer than all of eigentrail
TRACED = ("import eigentrail as et, numpy as np; "
          "loci = et.trace(et.Family(M=np.eye(1), K=[[[1.0]], [[3.0]]], parameter='p'), p=(0, 1)); ")


class Import(unittest.TestCase):
    def printed(self, text):
        return subprocess.run([sys.executable, "-W", "error", "-c", text], check=True, capture_output=True, text=True).stdout.strip()

    def test_nothing_is_imported_that_only_results_need(self):
        for statement in ("import eigentrail", "from eigentrail import Family, gradient, open, sweep, trace"):
            self.assertEqual(self.printed(f"{statement}; import sys; print(*({set(SLOW)} & set(sys.modules)))"), "", statement)

    def test_families_need_no_results_either(self):
        self.assertEqual(self.printed("import eigentrail as et, numpy as np, sys; et.Family(M=np.eye(2), K=[np.eye(2), np.eye(2)]); "
                                      f"et.Samples([0, 1], M=np.eye(1), K=[[[1]], [[2]]]); print(*({set(SLOW)} & set(sys.modules)))"), "")

    def test_results_have_their_accessor(self):
        self.assertEqual(self.printed(TRACED + "print(loci.eigentrail.parameter, callable(et.boundary), callable(et.sweep))"),
                         "p True True")

    def test_datasets_of_xarray_have_it_too(self):
        own = "print(hasattr(xarray.Dataset, 'eigentrail'), et.Eigentrail.__name__)"
        for imports in ("import xarray, eigentrail as et; ", "import eigentrail as et, xarray; et.Eigentrail; ",
                        "import xarray, eigentrail.accessor; et = eigentrail; ",
                        "import eigentrail.accessor, xarray; et = eigentrail; "):
            self.assertEqual(self.printed(imports + own), "True Eigentrail", imports)

    def test_what_the_package_does_not_have(self):
        with self.assertRaisesRegex(AttributeError, "module 'eigentrail' has no attribute 'nothing'"):
            import eigentrail
            eigentrail.nothing  # pylint: disable=pointless-statement


if __name__ == "__main__":
    unittest.main()
