#pragma once
/// Numbers and text as a reader wants them: SI prefixes, few digits, HTML-escaped.
#include <string>
#include <string_view>

namespace ambrig {

/// "36.2 um" with the sign µ, "1.75 mH", "16.8 kA/s", "0.26 ms". Units that take no prefix ("-",
/// "", "%", "deg", "rpm") are written as they are, with thousands separated by a thin gap: "12 000
/// rpm". NaN gives an en dash.
std::string FormatSi(double value, std::string_view unit, int digits = 3);

/// Without unit: at most `digits` significant ones, no exponent between 1e-4 and 1e7.
std::string FormatNumber(double value, int digits = 4);

/// "2 in 1.2e+06 switching periods of healthy coils": a detector judges each coil once a period;
/// "not watched" when it judged none.
std::string FalseAlarmText(double alarms, double coil_periods);

/// "12000 rpm" of a speed [rad/s].
std::string Rpm(double speed);

/// "3000 to 9000 rpm", or "at 6000 rpm", of two speeds [rad/s].
std::string SpeedRange(double lowest, double highest);

std::string HtmlEscape(std::string_view text);

/// HtmlEscape, and of markdown the least that a paragraph needs: **strong**, *stressed*, `code`.
std::string InlineMarkup(std::string_view text);

}  // namespace ambrig
