#pragma once
/// What a command writes is checked before its work starts: folders exist or can be made, files can
/// be written, nothing that ambrig did not make is overwritten without --force.
#include "app/commands/commands.h"

namespace ambrig {

/// Of an option that takes a number: from lo to hi, never nan.
CLI::Validator NumberIn(double lo, double hi, const std::string& unit);

/// A speed that names its unit ("3000rpm", "50 Hz", "314rad/s") as a number in `unit`; other texts
/// as they are.
/// @throws InputError for a unit that is none of a speed
std::string SpeedIn(const std::string& text, const std::string& unit);
/// The same for an option: a transform before its check.
CLI::Validator SpeedUnit(const std::string& unit);

/// Of an option that names a file to write: it is no folder, and its folder can be written.
CLI::Validator OutputFile();

/// Makes the folder, if need be, and tries that files can be written there. @throws InputError
void PrepareFolder(const std::string& folder);

/// Whether a file carries the mark of what ambrig writes (JSON, HTML, HDF5, CSV, TOML).
bool MadeByAmbrig(const std::string& file);

/// Writes a text file (TOML) with "# made by ambrig COMMAND" first, unless it has that mark, and a
/// hash of its lines at the end, which tells whether somebody changed it since.
void WriteMarkedText(const std::string& file, const std::string& command, const std::string& text);

/// Whether the lines of a file with such a hash are others than those that were written.
bool ChangedSinceWritten(const std::string& text);

/// @throws InputError when one of the files exists and ambrig did not make it, or somebody changed
/// it since, unless forced.
void RefuseOverwriting(const std::vector<std::string>& files, bool force);

/// Folder of a long work that keeps a journal there: made if need be, tried, and refused when it
/// holds one of `files` without the journal, that is another's. @throws InputError
void PrepareStudyFolder(const std::string& folder, const std::vector<std::string>& files,
                        bool force);

/// @throws InputError when the output would replace one of the files that the command reads.
void RefuseInputAsOutput(const std::string& output, const std::vector<std::string>& inputs);

/// @throws InputError when two of the outputs would be one file. Devices and empty names do not
/// count.
void RefuseOneFileTwice(const std::vector<std::string>& outputs);

/// Text of a JSON document with the mark: "made_by" first, then where it
/// comes from, unless the document says so itself (app/json/provenance.h).
std::string MarkedJson(nlohmann::ordered_json document);

}  // namespace ambrig
