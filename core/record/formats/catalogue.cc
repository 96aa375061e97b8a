/// The kinds of files that records are read from: one line per kind, which its file in this folder
/// describes. The content of a file decides in this order, then its extension.
#include "core/record/formats/format.h"

#define AMBRIG_FORMATS(FORMAT) \
  FORMAT(MatFormat)            \
  FORMAT(Hdf5Format)           \
  FORMAT(TdmsFormat)           \
  FORMAT(UniversalFile)        \
  FORMAT(LabviewText)          \
  FORMAT(AnalyzerTrace)        \
  FORMAT(CsvFormat)

namespace ambrig {

#define AMBRIG_DECLARE(name) RecordFormat name();
AMBRIG_FORMATS(AMBRIG_DECLARE)
#undef AMBRIG_DECLARE

std::span<const RecordFormat> RecordFormats() {
#define AMBRIG_MAKE(name) name(),
  static const RecordFormat all[] = {AMBRIG_FORMATS(AMBRIG_MAKE)};
#undef AMBRIG_MAKE
  return all;
}

}  // namespace ambrig
