#pragma once
/// Reports that teach: where the model fails, which effect is missing and why that one, what it
/// costs to believe it, what to measure next.
#include <string>

#include "discovery/decision/compare.h"
#include "discovery/decision/explain.h"

namespace ambrig {

void WriteCompareReport(const CaseModel& model, const Comparison& comparison,
                        const std::string& path);
void WriteExplainReport(const Case& c, const Explanation& explanation, const std::string& path);
/// Before and after adoption, with the ladder: error against effects added.
void WriteAdoptReport(const CaseModel& model, const Comparison& before, const Comparison& after,
                      const std::vector<LadderStep>& ladder, const std::string& path);

}  // namespace ambrig
