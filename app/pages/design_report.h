#pragma once
/// The page of a design study: candidates side by side.
#include "design/responses.h"

namespace ambrig {

/// `shown`: one point per candidate, in their order. @throws InputError when it cannot be written.
void WriteDesignReport(const Study& study, const StudyResult& result,
                       const std::vector<PointResponses>& shown, const std::string& path);

}  // namespace ambrig
