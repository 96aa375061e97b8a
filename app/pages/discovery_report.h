#pragma once
/// Reports that teach: where the model fails, which effect is missing and why that one, what it
/// costs to believe it, what to measure next.
#include <string>

#include "discovery/decision/compare.h"
#include "discovery/decision/explanation.h"

namespace ambrig {

void WriteCompareReport(const CaseModel& model, const Comparison& comparison,
                        const std::string& path);
void WriteExplainReport(const Case& c, const Explanation& explanation, const std::string& path);
/// Before and after adoption, with the ladder: error against effects added.
void WriteAdoptReport(const CaseModel& model, const Comparison& before, const Comparison& after,
                      const std::vector<LadderStep>& ladder, const std::string& path);

/// The names that the 95 % sets of the verdict "effect" leave: "side-pull at A", or "side-pull at A
/// (52 %) or sensor-gain at A.x (46 %)" where a set holds more than one; several effects are joined
/// by "and".
std::string AnswerText(const Explanation& e);
/// "" where every set holds one name; else "more than one effect remains" or, where it is one
/// effect and none of the catalogue, "no effect is certain".
std::string DoubtText(const Explanation& e);
/// Why the first of the ranking was not taken, "" where it was. `unseen`: some records were kept
/// back.
std::string WhyNot(const Explanation& e, bool unseen);

}  // namespace ambrig
