#pragma once
/// Text for a terminal of 80 columns.
#include <cstddef>
#include <string>
#include <string_view>

namespace ambrig {

inline constexpr std::size_t kScreenColumns = 80;

/// Columns that UTF-8 text takes; colours of the terminal take none.
std::size_t ScreenWidth(std::string_view text);

/// The text broken at spaces into lines of at most `columns`; lines after the first begin with
/// `indent` spaces. A word longer than a line (a path) stays whole, and so does a line to paste
/// behind "to mend it: ".
std::string Wrapped(std::string_view text, std::size_t indent,
                    std::size_t columns = kScreenColumns);

/// The text, or its beginning and "..." when it is wider than `columns`.
std::string Shortened(std::string_view text, std::size_t columns);

/// The text with the non-breaking spaces, micro and minus signs of a page as a terminal shows them.
std::string TerminalText(std::string text);

/// "36.2 um" of a value [unit], with an SI prefix and in ASCII; "-" when not finite.
std::string ScreenSi(double value, std::string_view unit, int digits = 4);

/// Every line of a help text within `columns`: what is longer is broken, and goes on below the
/// beginning of its description. Lines that begin with "  ambrig " are commands and stay.
std::string WrappedHelp(std::string_view text, std::size_t columns = kScreenColumns);

/// A message of one line, whatever a file's own text put into it.
std::string PrintableLine(const std::string& text);

}  // namespace ambrig
