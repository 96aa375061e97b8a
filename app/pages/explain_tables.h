#pragma once
/// Tables of the explain report: ranking, screening, price, and the snippet of a suggested law.
#include <string>

#include "app/pages/discovery_parts.h"

namespace ambrig {

std::string OneLine(std::string text);
/// `unseen`: some records were kept back from the fits.
void AddRanking(HtmlReport& report, const Explanation& e, bool unseen = true);
/// The 15 best of the quick look at everything, as bars.
void AddScreening(HtmlReport& report, const Explanation& e, bool unseen = true);
/// Parameters added with their sd, and how far the rig parameters had to move.
void AddCost(HtmlReport& report, const Explanation& e);
/// [[effect]] name = "formula" with the suggested law, every free letter declared.
std::string FormulaSnippet(const Unexplained& u);

}  // namespace ambrig
