#include "analysis/validation.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/validated_rig.h"
#include "analysis/validation_checks.h"
#include "core/base/counted.h"
#include "core/math/constants.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"
#include "rotor/shaft/beam_file.h"
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
constexpr const char* kQuantities =
    "mass,centre of mass,transverse inertia,polar inertia,free bending,pinned,natural frequencies,"
    "damped frequencies,damping ratios,critical speeds,unbalance response,eigenvalues,"
    "unstable poles,k_i,horseshoe k_i,k_s,force constant,unstable pole";

/// The rotor of a validation file.
struct Subject {
  bool beam = false;
  BeamFile file;       // beam
  ReducedRotor rigid;  // else
  LinearRotor loop;    // rigid with its feedback
  LinearRotor open;    // with the negative stiffness only
};

Subject ReadRigid(const TomlTable& root, const TomlTable& rotor) {
  Subject s;
  s.rigid.mass = rotor.Number("mass");
  s.rigid.inertia_transverse = rotor.Number("inertia_transverse");
  s.rigid.inertia_polar = rotor.Number("inertia_polar");
  s.rigid.J = Eigen::MatrixXd::Constant(1, 1, s.rigid.inertia_polar);
  s.loop = s.open = Linear(s.rigid);
  for (const TomlTable& t : root.Tables("loop")) {
    const Eigen::MatrixXd b = StationRows(StationAt(s.rigid, t.Number("z")));
    const Eigen::MatrixXd y = StationRows(StationAt(s.rigid, t.Number("sensor_z", t.Number("z"))));
    const double negative = t.Number("negative", 0);
    s.loop.K += b.transpose() * (t.Number("stiffness") * y - negative * b);
    s.loop.D += t.Number("damping", 0) * b.transpose() * y;
    s.open.K -= negative * b.transpose() * b;
    t.RejectUnknownKeys();
  }
  rotor.Choice("kind", "rigid", "rigid");
  return s;
}

Subject ReadSubject(const TomlTable& root) {
  const auto rotor = root.Table("rotor");
  if (!rotor) root.Fail("rotor", "is missing, allowed: [rotor], or rig = \"FILE\"");
  Subject s;
  if (rotor->Choice("kind", "beam", "beam,rigid") == "rigid") {
    s = ReadRigid(root, *rotor);
  } else {
    s.beam = true;
    s.file = ReadBeam(*rotor);
  }
  rotor->RejectUnknownKeys();
  return s;
}

/// The beam as this check wants it.
BeamDefinition Beam(const Subject& s, const TomlTable& check) {
  BeamDefinition d = s.file.definition;
  if (check.Bool("lumped", false)) d.theory.mass = MassKind::kLumped;
  if (check.Has("springs")) {
    d.supports.clear();
    for (const auto& row : check.Rows("springs")) {
      if (row.size() != 3) check.Fail("springs", "rows of three numbers are allowed: [z, k, c]");
      d.supports.push_back(IsotropicSupport(row[0], row[1], row[2]));
    }
  }
  return d;
}

LinearRotor RotorOf(const Subject& s, const TomlTable& check) {
  if (!s.beam) return s.loop;
  const BeamRotor beam = BuildBeam(Beam(s, check));
  const int reduced = static_cast<int>(check.Integer("reduced", 0));
  if (reduced == 0) return Assemble(beam);
  const ReducedRotor modal = Reduce(beam, reduced, {0.0});
  LinearRotor out = Linear(modal);
  for (const SpringSupport& support : beam.supports) AddSupport(modal, support, out);
  return out;
}

double FromSi(const std::string& unit, double omega) {
  return unit == "Hz" ? omega / (2 * kPi) : unit == "rpm" ? omega / kRpm : omega;
}

/// Frequencies or damping ratios of the modes at a speed, by natural frequency.
std::vector<double> ModesOf(const Subject& s, const TomlTable& check, const std::string& quantity,
                            const std::string& unit) {
  constexpr int kCount = 40;
  auto modes = WhirlModes(RotorOf(s, check), check.Number("speed_rpm", 0) * kRpm, kCount);
  std::stable_sort(modes.begin(), modes.end(),
                   [](const auto& a, const auto& b) { return a.omega_n < b.omega_n; });
  const double above = check.Number("above", 0);
  const auto every = static_cast<std::size_t>(check.Integer("every", 1));
  std::vector<double> out;
  std::size_t seen = 0;
  for (const WhirlMode& m : modes) {
    if (FromSi(unit == "-" ? "Hz" : unit, m.omega_n) < above || seen++ % every != 0) continue;
    out.push_back(quantity == "damping ratios"       ? m.zeta
                  : quantity == "damped frequencies" ? FromSi(unit, m.omega_d)
                                                     : FromSi(unit, m.omega_n));
  }
  return out;
}

std::vector<double> Frequencies(const Eigen::VectorXd& omega, const std::string& unit) {
  std::vector<double> out;
  for (double w : omega) out.push_back(FromSi(unit, w));
  return out;
}

std::vector<double> UnbalanceAmplitudes(const Subject& s, const TomlTable& check) {
  const BeamRotor beam = BuildBeam(Beam(s, check));
  const LinearRotor rotor = Assemble(beam);
  const auto u = check.Table("unbalance");
  if (!u) check.Fail("unbalance", "is missing, allowed: { z, magnitude, at }");
  const int node = NodeOf(beam, *u, "z", u->Number("z")),
            at = NodeOf(beam, *u, "at", u->Number("at"));
  const double magnitude = u->Number("magnitude");
  u->RejectUnknownKeys();
  std::vector<double> out;
  for (double rpm : check.Numbers("speeds_rpm"))
    out.push_back(std::abs(UnbalanceResponse(rotor, {{node, magnitude, 0}}, rpm * kRpm)(4 * at)));
  return out;
}

/// Real and imaginary parts of the modes nearest to the published ones.
void Eigenvalues(const Subject& s, const TomlTable& check, ValidationRow& row) {
  const auto modes = WhirlModes(RotorOf(s, check), check.Number("speed_rpm", 0) * kRpm, 40);
  for (const auto& pair : check.Rows("published")) {
    if (pair.size() != 2)
      check.Fail("published", "rows of two numbers are allowed: [real, imaginary]");
    const Complex wanted(pair[0], std::abs(pair[1]));
    Complex nearest = 1e300;
    for (const WhirlMode& m : modes)
      if (std::abs(m.s - wanted) < std::abs(nearest - wanted)) nearest = m.s;
    row.published.insert(row.published.end(), {pair[0], std::abs(pair[1])});
    row.ours.insert(row.ours.end(), {nearest.real(), nearest.imag()});
    row.difference = std::max(row.difference, std::abs(nearest - wanted) / std::abs(wanted));
  }
}

std::vector<double> UnstablePoles(const Subject& s) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(-s.open.K, s.open.M);
  std::vector<double> out;
  for (Eigen::Index k = 0; k < eigen.eigenvalues().size(); k += 2)  // both planes alike
    if (eigen.eigenvalues()(k) > 0) out.push_back(std::sqrt(eigen.eigenvalues()(k)));
  return out;
}

std::vector<double> OfRotor(const Subject& s, const TomlTable& check, const std::string& quantity,
                            const std::string& unit) {
  if (quantity == "unstable poles") return UnstablePoles(s);
  if (quantity == "natural frequencies" || quantity == "damped frequencies" ||
      quantity == "damping ratios")
    return ModesOf(s, check, quantity, unit);
  if (!s.beam) check.Fail("quantity", fmt::format("\"{}\" needs a beam rotor", quantity));
  if (quantity == "unbalance response") return UnbalanceAmplitudes(s, check);
  const BeamRotor beam = BuildBeam(Beam(s, check));
  const RotorTotals totals = Totals(beam);
  if (quantity == "mass") return {totals.mass};
  if (quantity == "centre of mass") return {totals.z_com};
  if (quantity == "transverse inertia") return {totals.inertia_transverse};
  if (quantity == "polar inertia") return {totals.inertia_polar};
  const int count = static_cast<int>(check.Numbers("published").size());
  if (quantity == "free bending") return Frequencies(FreeModes(beam, count).omega, unit);
  if (quantity == "pinned") {
    std::vector<int> held;
    for (double z : check.Numbers("planes")) held.push_back(2 * NodeOf(beam, check, "planes", z));
    return Frequencies(HeldModes(beam, held, count).omega, unit);
  }
  if (quantity == "critical speeds") {
    std::vector<double> out;
    const LinearRotor rotor = Assemble(beam);
    CheckSprings(check, rotor);
    for (const CriticalSpeed& c : CriticalSpeeds(rotor, count))
      out.push_back(FromSi(unit, c.speed));
    return out;
  }
  check.Fail("quantity", fmt::format("\"{}\" is a quantity of a rig, not of a rotor", quantity));
}

void Compare(const TomlTable& check, ValidationRow& row, const std::vector<double>& ours) {
  row.published = check.Numbers("published");
  const bool nearest = check.Choice("match", "order", "order,nearest") == "nearest";
  if (row.published.empty()) check.Fail("published", "is empty");
  if (!nearest && ours.size() < row.published.size())
    check.Fail("published", fmt::format("has {}, to compare with: {}",
                                        Counted(row.published.size(), "figure"), ours.size()));
  for (std::size_t k = 0; k < row.published.size(); ++k) {
    const double p = row.published[k];
    double mine = nearest ? kInfinity : ours[k];
    if (nearest)
      for (double o : ours)
        if (std::abs(o - p) < std::abs(mine - p)) mine = o;
    row.ours.push_back(mine);
    row.difference = std::max(row.difference, std::abs(mine - p) / std::abs(p));
  }
}

}  // namespace

std::vector<ValidationRow> Validate(const std::string& file) {
  const TomlTable root = TomlTable::FromFile(file);
  ValidationRow common;
  common.file = file;
  common.name = root.String("name");
  common.source = root.String("source");
  common.trust = root.Choice("trust", "published", "published,computed,low");
  const bool of_rig = root.Has("rig");
  Subject subject;
  RigParameters rig;
  if (of_rig)
    rig = ReadRig((std::filesystem::path(file).parent_path() / root.String("rig")).string());
  else
    subject = ReadSubject(root);
  std::vector<ValidationRow> rows;
  for (const TomlTable& check : root.Tables("check")) {
    ValidationRow row = common;
    row.quantity = check.Choice("quantity", "", kQuantities);
    row.unit = check.String("unit", "-");
    row.trust = check.Choice("trust", common.trust, "published,computed,low");
    row.note = check.String("note", "");
    row.tolerance = check.Number("tolerance", 0.005);
    if (row.quantity == "eigenvalues")
      Eigenvalues(subject, check, row);
    else
      Compare(check, row,
              of_rig ? FiguresOfRig(rig, check, row.quantity)
                     : OfRotor(subject, check, row.quantity, row.unit));
    const double rpm = check.Number("speed_rpm", 0);
    if (rpm != 0) row.quantity += fmt::format(", {:g} rpm", rpm);
    check.RejectUnknownKeys();
    rows.push_back(std::move(row));
  }
  root.RejectUnknownKeys();
  if (rows.empty()) root.Fail("check", "is missing, allowed: tables, each written [[check]]");
  return rows;
}

}  // namespace ambrig
