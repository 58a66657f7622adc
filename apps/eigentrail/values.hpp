// Values of a parameter on the command line: "40", "10,20", "0:5:40", "100 Hz".
#pragma once

#include <string>
#include <vector>

#include "eigentrail/scene/scene.hpp"

namespace eigentrail::app {

/// The values that the texts of an option stand for, in the unit of the parameter. A text is a value, a list
/// "10,20", or a range "begin:step:end" whose end belongs to it where the steps meet it. Values may have
/// units; those of the last number in a text hold for all. Throws InputError that names the option.
std::vector<double> read_values(const std::string& option, const std::vector<std::string>& texts,
                                const Parameter& parameter);

/// One value.
double read_value(const std::string& option, const std::string& text, const Parameter& parameter);

/// The parameter of a scene with this name; one without a unit where there is none, which is reported where
/// the options are checked.
Parameter parameter_called(const Scene& scene, const std::string& name);

/// The parameter of a loci file, whose unit values are in. A unit that this version does not know counts as
/// none.
Parameter parameter_of_file(const std::string& name, const std::string& unit);

}  // namespace eigentrail::app
