#include "fdd/learning/commissioning_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/base/fingerprint.h"
#include "core/base/toml.h"

namespace ambrig {

namespace {

std::string Numbers(const double* v, int n) {
  std::string text;
  for (int k = 0; k < n; ++k) text += fmt::format("{}{}", k ? ", " : "", v[k]);
  return "[" + text + "]";
}

/// Every number of a parameter table, in its order.
template <class P, std::size_t n>
void Append(const P& p, const Field<P> (&fields)[n], std::string* text) {
  for (const Field<P>& f : fields) *text += fmt::format("{}={};", f.key, p.*f.at);
}

void ReadLane(const TomlTable& t, const std::string& key, int coils, double lo, double hi,
              Lane* out) {
  const auto v = t.Numbers(key);
  if (static_cast<int>(v.size()) != coils)
    t.Fail(key, fmt::format("has {} numbers, allowed: {}, one per coil", v.size(), coils));
  for (int j = 0; j < coils; ++j) {
    if (!(v[static_cast<std::size_t>(j)] >= lo && v[static_cast<std::size_t>(j)] <= hi))
      t.Fail(key, fmt::format("= {}, allowed: {} to {}", v[static_cast<std::size_t>(j)], lo, hi));
    (*out)[j] = v[static_cast<std::size_t>(j)];
  }
}

double In(const TomlTable& t, const char* key, double lo, double hi) {
  const double v = t.Number(key);
  if (!(v >= lo && v <= hi)) t.Fail(key, fmt::format("= {}, allowed: {} to {}", v, lo, hi));
  return v;
}

std::vector<double> Exactly(const TomlTable& t, const char* key, std::size_t n) {
  const auto v = t.Numbers(key);
  if (v.size() != n) t.Fail(key, fmt::format("has {} numbers, allowed: {}", v.size(), n));
  return v;
}

/// Files of bearings without run-out do not have it.
void ReadRunOut(const TomlTable& t, RunOut* out) {
  for (const auto& [key, terms] : {std::pair{"run_out_x", &out->x}, {"run_out_y", &out->y}}) {
    if (!t.Has(key)) continue;
    const auto v = Exactly(t, key, kRunOutTerms);
    std::copy(v.begin(), v.end(), terms->begin());
  }
}

CommissionedBearing ReadBearing(const TomlTable& t, const std::string& name) {
  CommissionedBearing b;
  b.name = name;
  b.learnt = true;
  b.learnt_on = t.String("learnt_on");
  const int coils = static_cast<int>(In(t, "coils", 1, kLanes));
  b.grade = In(t, "grade", 0, 1e9);
  b.rows = t.Integer("rows", 0);
  const auto zero = Exactly(t, "sensor_zero", 2), knee = Exactly(t, "knee", 2),
             relaxation = Exactly(t, "relaxation", kRelaxations);
  b.circuit.dx = zero[0];
  b.circuit.dy = zero[1];
  b.circuit.path = In(t, "iron_path", -1, 10);
  b.circuit.fringing = In(t, "fringing", -1, 10);
  ReadRunOut(t, &b.circuit.run_out);
  b.circuit.knee7 = knee[0];
  b.circuit.knee15 = knee[1];
  for (std::size_t m = 0; m < kRelaxations; ++m) b.circuit.relaxation[m] = relaxation[m];
  ReadLane(t, "gain", coils, 1e-3, 1e3, &b.coils.gain);
  ReadLane(t, "leakage", coils, -1e3, 1e3, &b.coils.leakage);
  ReadLane(t, "resistance", coils, -1e4, 1e4, &b.coils.resistance);
  if (t.Has("offset")) ReadLane(t, "offset", coils, -1e4, 1e4, &b.coils.offset);
  for (int w = 0; w < kExcessWindows; ++w)
    ReadLane(t, fmt::format("largest_{}", kExcessWindow[w]), coils, 0, 1e3, &b.largest[w]);
  ReadLane(t, "largest_flux", coils, 0, 1e6, &b.largest_flux);
  ReadLane(t, "current_error", coils, 0, 1e6, &b.current_error);
  b.pattern = In(t, "pattern", 0, 1e3);
  t.RejectUnknownKeys();
  return b;
}

/// "bearings.A.gap 1a2b3c4d"; the bearing of a part is told by its reader.
std::vector<MachineIdentity::Part> ReadParts(const TomlTable& t, const char* key) {
  std::vector<MachineIdentity::Part> parts;
  for (const std::string& text : t.Strings(key)) {
    const auto space = text.rfind(' ');
    if (space == std::string::npos || space == 0)
      t.Fail(key, fmt::format("has \"{}\", allowed: a name, a space and a hash", text));
    parts.push_back({text.substr(0, space), text.substr(space + 1), ""});
  }
  return parts;
}

/// Files of earlier versions do not have it.
MachineIdentity ReadMachine(const TomlTable& root) {
  MachineIdentity machine;
  const auto t = root.Table("machine");
  if (!t) return machine;
  machine.known = true;
  machine.unit = In(*t, "unit", 1, 1e9);
  machine.fitted = ReadParts(*t, "fitted");
  machine.effects = ReadParts(*t, "effects");
  t->RejectUnknownKeys();
  return machine;
}

std::string PartsText(const std::vector<MachineIdentity::Part>& parts) {
  std::string text;
  for (const MachineIdentity::Part& p : parts)
    text += fmt::format("{}\"{} {}\"", text.empty() ? "" : ", ", p.name, p.hash);
  return "[" + text + "]";
}

std::string MachineText(const MachineIdentity& m) {
  if (!m.known) return "";
  return fmt::format(
      "\n# beside the nominal values: with others the file is of another machine and not used\n"
      "[machine]\nunit = {}\nfitted = {}\neffects = {}\n",
      m.unit, PartsText(m.fitted), PartsText(m.effects));
}

int CoilsIn(const CommissionedBearing& b) {
  int n = 0;
  while (n < kLanes && b.coils.gain[n] > 0) ++n;
  return n;
}

std::string BearingText(const CommissionedBearing& b) {
  const int n = CoilsIn(b);
  const FluxCircuit& c = b.circuit;
  std::string text = fmt::format(
      "\n[bearings.{}]\nlearnt_on = \"{}\"    # nominal values\ncoils = {}\ngrade = {}    # mean "
      "square of the residuals over their "
      "expected size; above {} it is refused\nrows = {}\n",
      b.name, b.learnt_on, n, b.grade, kWorstGrade, b.rows);
  text += fmt::format(
      "# these trade against each other: together they predict fluxes, one alone says nothing\n"
      "sensor_zero = [{}, {}]    # m\niron_path = {}\nfringing = {}\nrelaxation = {}    # residues "
      "at 100 Hz, 1.2, 12 and 120 kHz\nknee = [{}, {}]\n",
      c.dx, c.dy, c.path, c.fringing, Numbers(c.relaxation.data(), kRelaxations), c.knee7,
      c.knee15);
  if (!c.run_out.none())
    text += fmt::format(
        "# errors of the reading that turn with the shaft: cos and sin of its angle, of twice it, "
        "m\n"
        "run_out_x = {}\nrun_out_y = {}\n",
        Numbers(c.run_out.x.data(), kRunOutTerms), Numbers(c.run_out.y.data(), kRunOutTerms));
  text +=
      fmt::format("gain = {}\nleakage = {}    # H\nresistance = {}    # ohm\noffset = {}    # V\n",
                  Numbers(b.coils.gain.v, n), Numbers(b.coils.leakage.v, n),
                  Numbers(b.coils.resistance.v, n), Numbers(b.coils.offset.v, n));
  text += "# what healthy running reached: relative excess of the slope over so many periods\n";
  for (int w = 0; w < kExcessWindows; ++w)
    text += fmt::format("largest_{} = {}\n", kExcessWindow[w], Numbers(b.largest[w].v, n));
  text += fmt::format("largest_flux = {}    # A over the nominal gap\ncurrent_error = {}    # A\n",
                      Numbers(b.largest_flux.v, n), Numbers(b.current_error.v, n));
  return text + fmt::format("pattern = {}\n", b.pattern);
}

}  // namespace

std::string ContentHashOf(const LinkageModel& m, const AmplifierParameters& amplifier) {
  std::string text;
  Append(amplifier, kAmplifierFields, &text);
  text += fmt::format("|{} {} {} {} {}", static_cast<int>(m.coupling), m.reluctance.per_metre,
                      m.reluctance.offset, m.reluctance.iron_path, m.reluctance.fringing);
  for (int j = 0; j < m.coils; ++j)
    text += fmt::format(";{} {} {} {} {} {}", m.n[j], m.leakage[j], m.resistance[j],
                        m.direction_x[j], m.direction_y[j], m.gap_offset[j]);
  return fmt::format("{:016x}", Fingerprint(text));
}

std::string CommissioningText(const CommissionedModel& model) {
  std::string text =
      "# Written by ambrig commission: what the detector learnt of the healthy machine.\n";
  text += MachineText(model.machine);
  for (const CommissionedBearing& b : model.bearings)
    if (b.learnt) text += BearingText(b);
  return text;
}

CommissionedModel ReadCommissioning(const std::string& file) {
  const TomlTable root = TomlTable::FromFile(file);
  const auto bearings = root.Table("bearings");
  if (!bearings)
    root.Fail("bearings",
              "is missing, allowed: tables [bearings.NAME], as ambrig commission writes");
  CommissionedModel model;
  model.machine = ReadMachine(root);
  for (const std::string& name : bearings->Keys())
    model.bearings.push_back(ReadBearing(*bearings->Table(name), name));
  root.RejectUnknownKeys();
  return model;
}

std::string CommissioningFileOf(const std::string& rig_file) {
  const std::filesystem::path path(rig_file);
  return (path.parent_path() / (path.stem().string() + ".commissioning.toml")).string();
}

bool FitsBearing(const std::string& file, const std::string& name, const LinkageModel& nominal,
                 const AmplifierParameters& amplifier) {
  if (!std::filesystem::is_regular_file(file)) return false;
  const CommissionedModel model = ReadCommissioning(file);
  const CommissionedBearing* found = model.Find(name);
  return found && found->learnt_on == ContentHashOf(nominal, amplifier);
}

CommissionedBearing ReadCommissionedBearing(const std::string& file, const std::string& name,
                                            const LinkageModel& nominal,
                                            const AmplifierParameters& amplifier) {
  if (file.empty()) return NominalBearing(name, nominal);
  const CommissionedModel model = ReadCommissioning(file);
  const CommissionedBearing* found = model.Find(name);
  if (!found) return NominalBearing(name, nominal);
  const std::string hash = ContentHashOf(nominal, amplifier);
  if (found->learnt_on != hash)
    throw InputError(fmt::format(
        "{}: bearings.{}.learnt_on = \"{}\", allowed: \"{}\" - the nominal values of the rig have "
        "changed since; run ambrig commission again",
        file, name, found->learnt_on, hash));
  return *found;
}

}  // namespace ambrig
