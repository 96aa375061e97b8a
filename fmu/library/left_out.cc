/// What an FMU does without, so that it needs no library beside it: HDF5 and MAT files, zip
/// archives, formulas of effects. `ambrig export` refuses a rig that would come here.
#include "core/base/errors.h"
#include "core/base/zip_file.h"
#include "core/record/hdf5.h"
#include "core/record/mat.h"
#include "effects/formula_parser.h"

namespace ambrig {

namespace {
[[noreturn]] void LeftOut(const std::string& what) {
  throw InputError(what +
                   ": an FMU has no reader of it, allowed: CSV files, effects without formulas");
}
}  // namespace

Record ReadHdf5(const std::string& path) { LeftOut(path); }
Record ReadHdf5Group(const std::string& path, const std::string&) { LeftOut(path); }
void WriteHdf5(const Record&, const std::string& path) { LeftOut(path); }
void WriteHdf5Groups(const std::vector<std::pair<std::string, Record>>&,
                     const std::map<std::string, std::string>&, const std::string& path) {
  LeftOut(path);
}
std::mutex& Hdf5Mutex() {
  static std::mutex mutex;
  return mutex;
}
Measurement ReadMatMeasurement(const std::string& path) { LeftOut(path); }
Record ReadMat(const std::string& path) { LeftOut(path); }
void WriteMat(const Record&, const std::string& path) { LeftOut(path); }

void WriteZip(const std::string& path, const std::vector<ZipEntry>&) { LeftOut(path); }
void UnpackZip(const std::string& path, const std::string&) { LeftOut(path); }

struct FormulaExpression::Inside {};
FormulaExpression::FormulaExpression(const std::string&, const std::vector<std::string>&,
                                     const std::string& where) {
  LeftOut(where);
}
FormulaExpression::~FormulaExpression() = default;
FormulaExpression::FormulaExpression(FormulaExpression&&) noexcept = default;
double FormulaExpression::operator()(const double*) const { return 0; }
const std::string& FormulaFunctions() {
  static const std::string none;
  return none;
}
bool IsFormulaName(const std::string&) { return false; }

}  // namespace ambrig
