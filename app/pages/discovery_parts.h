#pragma once
/// What the reports of compare, explain and adopt share: the ladder, the heat map of records and
/// channels, effects and their parameters in words.
#include <string>
#include <vector>

#include "app/figures/ratio_figure.h"
#include "app/figures/residual_data.h"
#include "app/pages/html.h"
#include "discovery/decision/compare.h"
#include "discovery/decision/explanation.h"

namespace ambrig {

/// How to read "error over noise", once per report.
/// `fitted`: parameters were adjusted to some of the records (explain), or will be (compare).
void AddReadingHelp(HtmlReport& report, bool fitted);

/// `scale`: the largest ratio that the colours are chosen for, 0: of this map; two maps to be
/// compared share one.
void AddRatioMap(HtmlReport& report, const Comparison& comparison, const std::string& caption,
                 double scale = 0);
/// The same from a residual.
void AddRatioMap(HtmlReport& report, const CaseModel& model, const std::vector<double>& residual,
                 const std::string& caption, double scale = 0);
/// Largest ratio of any channel of any record.
double LargestRatio(const Comparison& comparison);

/// Figure and table: error against what was believed, on fitted and on unseen records.
void AddLadder(HtmlReport& report, const std::vector<LadderStep>& ladder);

/// Which block the error sits in, or that the block tests do not tell; empty without them.
std::string BlockText(const Comparison& c);

std::string List(const std::vector<std::string>& lines);
/// "eddy-currents at A"
std::string EffectName(const EffectInstance& e);
/// "3.20 ± 0.14 kHz", both in one unit; the sd is left out where unknown.
std::string ValueText(double value, double sd, const std::string& unit);
/// "cutoff = 3.2 ± 0.1 kHz, path = ..."
std::string ParametersText(const EffectInstance& e);

}  // namespace ambrig
