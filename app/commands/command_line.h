#pragma once
/// The command line of `ambrig`: help, what is said of a wrong line, and the command's work.

namespace ambrig {

/// Reads the arguments, does the work of the command, returns its exit code; a line that names no
/// work gives 0 (help, version, nothing at all) or 2 with one line on the standard error output.
/// @throws what the work throws
int RunCommandLine(int argc, char** argv);

}  // namespace ambrig
