#include "model/readers.hpp"

#include "model/add_element.hpp"
#include "model/beam_builder.hpp"

namespace eigentrail {
namespace {

class BeamReader {
 public:
  BeamReader(Draft& draft, TableReader& table) : draft_(draft), table_(table) {}

  BeamDesign read() {
    BeamDesign design;
    design.name = read_beam_name(draft_, table_);
    design.ends = {read_end("from"), read_end("to")};
    read_holds(design.ends);
    check_apart(design.ends);
    read_elements(table_, design);
    design.y = draft_.read_vector(table_, "y_axis", any_unit, Range::positive, unit_vector(1));
    check_across(design.ends, design.y);
    design.sections = read_beam_table(draft_, table_);
    table_.finish();
    return design;
  }

 private:
  BeamEnd read_end(const std::string& key) {
    BeamEnd end;
    end.place = draft_.read_place(table_, key, &end.carrier);
    if (end.carrier.point >= 0)
      table_.fail(key, "a point has no orientation; a beam needs a body or a fixed place");
    end.position = draft_.at_guess(end.place);
    return end;
  }

  /// By default a beam is welded to bodies, clamped in the frame where it begins, and free where it ends.
  void read_holds(std::array<BeamEnd, 2>& ends) {
    ends[0].clamped = true;
    ends[1].clamped = !ends[1].carrier.is_frame();
    if (!table_.has("ends")) return;
    const std::vector<std::string> holds = table_.texts("ends");
    if (holds.size() != 2) table_.fail("ends", "expected two texts, for from and to");
    for (std::size_t i = 0; i < 2; ++i) {
      if (holds[i] != "clamped" && holds[i] != "free")
        table_.fail("ends", "expected \"clamped\" or \"free\", found \"" + holds[i] + "\"");
      ends[i].clamped = holds[i] == "clamped";
    }
  }

  void check_apart(const std::array<BeamEnd, 2>& ends) {
    draft_.require(table_, "to", "must be apart from `from`; both are at the same place", [&](std::size_t i) {
      return draft_.vector_at(ends[1].position - ends[0].position, i).norm() > 0.0;
    });
  }

  void check_across(const std::array<BeamEnd, 2>& ends, const ExpressionVector& y) {
    const ExpressionVector chord = ends[1].position - ends[0].position;
    for (std::size_t i = 0; i < draft_.check_at.size(); ++i) {
      if (!draft_.are_parallel(chord, y, 1e-9, i)) continue;
      table_.fail("y_axis", "must not be parallel to the beam; it is" + Draft::where_on_trace(i) +
                                ". It is the direction of the y axis of the sections, [0, 1, 0] by default");
    }
  }

  Draft& draft_;
  TableReader& table_;
};

std::string section_label(const BeamDraft& beam, std::size_t i) {
  return beam.name + ", quadrature point " + std::to_string(i + 1);
}

/// Damping of all quadrature points of a beam by one time, or by one for each strain.
void add_damping(Draft& draft, const BeamDraft& beam, const std::vector<Expression>& times) {
  BeamDamping damping;
  damping.time = draft.quantity(times.size() == 1 ? times[0] : Expression(1.0));
  for (std::size_t i = 0; times.size() == 6 && i < 6; ++i) damping.roots[i] = draft.quantity(sqrt(times[i]));
  for (std::size_t i = 0; i < beam.sections.size(); ++i) {
    static_cast<BeamPoint&>(damping) = beam.sections[i];
    add_element(draft, damping, section_label(beam, i));
  }
}

}  // namespace

void check_time(Draft& draft, const TableReader& table, const std::string& key, const Expression& time,
                bool has_root) {
  draft.check_range(table, key, time, Range::non_negative);
  if (!has_root || time.is_constant()) return;
  const std::vector<double> values = draft.check_values(time);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == 0.0)
      table.fail(key, "must be the number 0, or positive all along the trace; it is zero" +
                          Draft::where_on_trace(i) + ". The damping has no derivative by it there");
  }
}

void read_beams(Draft& draft) {
  draft.for_each_table(BeamSection::name, [&](TableReader& table, std::size_t) {
    add_beam(draft, table, BeamReader(draft, table).read());
  });
}

void add_beam_sections(Draft& draft) {
  for (const BeamDraft& beam : draft.beams) {
    for (std::size_t i = 0; i < beam.sections.size(); ++i)
      add_element(draft, beam.sections[i], section_label(beam, i));
  }
}

void read_beam_damping(Draft& draft) {
  for (const BeamDraft& beam : draft.beams) {
    if (!beam.damping_times.empty()) add_damping(draft, beam, beam.damping_times);
  }
  draft.for_each_table(BeamDamping::name, [&](TableReader& table, std::size_t) {
    const BeamDraft& beam =
        draft.beams[index_of(table.text("beam"), names_of(draft.beams), table, "beam", "beam")];
    const std::vector<Expression> times = table.list("time", "s");
    if (times.size() != 1 && times.size() != 6)
      table.fail("time",
                 "expected one number or six, one for each strain; found " + std::to_string(times.size()));
    for (const Expression& time : times) check_time(draft, table, "time", time, times.size() == 6);
    table.finish();
    add_damping(draft, beam, times);
  });
}

std::vector<FieldHelp> beam_fields() {
  const auto [elements, degree] = element_fields();
  std::vector<FieldHelp> fields = {
      {"name", "text", "its nodes are the bodies NAME.root, NAME.1, NAME.2, ..., NAME.tip"},
      {"from", "place", "where it begins; welded to the body, or clamped in the frame"},
      {"to", "place", "where it ends; welded to the body, or free if a position is given"},
      {"ends", "two texts", "\"clamped\" or \"free\", for from and to", "as said there"},
      elements,
      degree,
      {"y_axis", "[x, y, z]", "direction of the y axis of the sections, as far as it is normal to the beam",
       "[0, 1, 0]"}};
  for (FieldHelp& field : beam_table_fields()) fields.push_back(std::move(field));
  return fields;
}

std::vector<FieldHelp> beam_damping_fields() {
  return {{"beam", "name of a beam", "the beam"},
          {"time", "s",
           "stresses are the stiffness times this times the rates of the strains; or six times, of "
           "extension, shear along y and z, twist, bending about y and z"}};
}

}  // namespace eigentrail
