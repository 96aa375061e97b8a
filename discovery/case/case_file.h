#pragma once
/// The text of a case file, changed as its user would: comments and layout stay.
#include <string>

#include "discovery/case/case.h"

namespace ambrig {

/// As ReadCase, of a text that could stand in `file`: names are relative to its folder. @throws
/// InputError
Case ReadCaseText(const std::string& text, const std::string& file);

/// How a text that stands in `folder` names `file`.
std::string NameFrom(const std::string& folder, const std::string& file);

/// The text of case file `file` with another rig file, to be written as `output`, perhaps in
/// another folder: relative names of scenarios and data are then named from there. @throws
/// InputError
std::string CaseWithRig(const std::string& text, const std::string& file, const std::string& rig,
                        const std::string& output);

}  // namespace ambrig
