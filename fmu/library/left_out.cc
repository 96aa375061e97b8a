/// What an FMU does without, so that it needs no library beside it: HDF5 and MAT files, zip
/// archives, formulas of effects, H-infinity synthesis, the Open Dynamics Engine. `ambrig export`
/// refuses a rig that would come here.
#include "control/synthesis/slicot.h"
#include "core/base/errors.h"
#include "core/base/zip_file.h"
#include "core/record/hdf5.h"
#include "core/record/mat.h"
#include "effects/formula_parser.h"
#include "rotor/crosscheck/ode_world.h"

namespace ambrig {

namespace {
[[noreturn]] void LeftOut(const std::string& what) {
  throw InputError(
      what +
      ": an FMU does without it; allowed: CSV files, effects without formulas, other controllers");
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

HInfinityOutcome DiscreteHInfinity(const StateSpace&, int, int, double) {
  LeftOut("kind = \"h-infinity\"");
}

// The second witness of contact, which no run asks for.
struct OdeWorld::Library {};
OdeWorld::OdeWorld() { LeftOut("Open Dynamics Engine"); }
OdeWorld::~OdeWorld() = default;
int OdeWorld::AddBody(double, const Eigen::Vector3d&, bool) { return 0; }
void OdeWorld::AddHinge(int, int, const Eigen::Vector3d&) {}
void OdeWorld::SetPose(int, const Eigen::Vector3d&, const Eigen::Matrix3d&) {}
void OdeWorld::SetVelocity(int, const Eigen::Vector3d&) {}
void OdeWorld::SetTurning(int, const Eigen::Vector3d&) {}
Eigen::Vector3d OdeWorld::Place(int) const { return Eigen::Vector3d::Zero(); }
Eigen::Matrix3d OdeWorld::Turn(int) const { return Eigen::Matrix3d::Identity(); }
Eigen::Vector3d OdeWorld::Velocity(int) const { return Eigen::Vector3d::Zero(); }
Eigen::Vector3d OdeWorld::Turning(int) const { return Eigen::Vector3d::Zero(); }
void OdeWorld::AddForce(int, const Eigen::Vector3d&) {}
void OdeWorld::AddTorque(int, const Eigen::Vector3d&) {}
void OdeWorld::AddContact(const OdeContact&) {}
void OdeWorld::AddMotor(int, const Eigen::Vector3d&, double) {}
void OdeWorld::Step(double) {}
long OdeWorld::Warnings() { return 0; }

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
