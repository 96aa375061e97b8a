#include "discovery/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/residual_peaks.h"
#include "scenarios/residual_force.h"

namespace ambrig {

namespace {

struct Worst {
  const Target* target = nullptr;
  double ratio = 0;
};

Worst FindWorst(const CaseModel& model, const FitResult& fit, bool readings_only) {
  Worst worst;
  for (const Target& t : model.targets()) {
    const std::string& name = model.data().records[t.record].data.channels[t.channel].name;
    if (readings_only && !(name.ends_with(".x") || name.ends_with(".y") || name == "z")) continue;
    const double r = TargetRatio(model, fit.residual, t);
    if (r > worst.ratio) worst = {&t, r};
  }
  return worst;
}

/// The missing force of a plane against what it may depend on: share of its power that each explains.
struct Dependence {
  std::string on, formula;
  double share = 0;
};

double Share(const std::vector<std::vector<double>>& columns, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(y.size());
  Eigen::MatrixXd A(n, static_cast<Eigen::Index>(columns.size()) + 1);
  Eigen::VectorXd b(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    A(k, 0) = 1;
    for (std::size_t c = 0; c < columns.size(); ++c) A(k, static_cast<Eigen::Index>(c) + 1) = columns[c][static_cast<std::size_t>(k)];
    b(k) = y[static_cast<std::size_t>(k)];
  }
  const double mean = b.mean(), total = (b.array() - mean).square().sum();
  if (total <= 0) return 0;
  const Eigen::VectorXd x = A.colPivHouseholderQr().solve(b);
  return 1 - (A * x - b).squaredNorm() / total;
}

/// One-sided contact: direction and gap for which max(projection - gap, 0) explains most.
struct Contact {
  double share = 0, angle = 0, gap = 0;
};

Contact FindContact(const ResidualForce::Plane& p) {
  Contact best;
  const std::size_t n = p.x.size(), stride = std::max<std::size_t>(1, n / 1500);
  for (int d = 0; d < 24; ++d) {
    const double angle = 2 * kPi * d / 24, c = std::cos(angle), s = std::sin(angle);
    std::vector<double> along;
    for (std::size_t k = 0; k < n; k += stride) along.push_back(p.x[k] * c + p.y[k] * s);
    std::vector<double> sorted = along;
    std::sort(sorted.begin(), sorted.end());
    for (double q : {0.3, 0.5, 0.7, 0.85}) {
      const double gap = sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
      std::vector<double> depth, force;
      for (std::size_t m = 0; m < along.size(); ++m) {
        depth.push_back(std::max(0.0, along[m] - gap));
        force.push_back(-(p.fx[m * stride] * c + p.fy[m * stride] * s));
      }
      const double share = Share({depth}, force);
      if (share > best.share) best = {share, angle, gap};
    }
  }
  return best;
}

Dependence FindDependence(const ResidualForce& f, const ResidualForce::Plane& p) {
  const auto turning = [&](double order) {
    std::vector<std::vector<double>> out(2);
    for (double th : f.theta) {
      out[0].push_back(std::cos(order * th));
      out[1].push_back(std::sin(order * th));
    }
    return out;
  };
  const auto mean_share = [&](const std::vector<std::vector<double>>& c) { return 0.5 * (Share(c, p.fx) + Share(c, p.fy)); };
  std::vector<Dependence> all;
  all.push_back({"position (linear)", "force = { x = \"-kxx*x - kxy*y\", y = \"-kyx*x - kyy*y\" }", mean_share({p.x, p.y})});
  all.push_back({"velocity (linear)", "force = { x = \"-cxx*vx - cxy*vy\", y = \"-cyx*vx - cyy*vy\" }", mean_share({p.vx, p.vy})});
  if (std::abs(f.omega.back()) > 1) {
    all.push_back({"angle, order 1", "force = { x = \"c*cos(theta) - s*sin(theta)\", y = \"c*sin(theta) + s*cos(theta)\" }", mean_share(turning(1))});
    all.push_back({"angle, order 2", "force = { x = \"c*cos(2*theta) - s*sin(2*theta)\", y = \"c*sin(2*theta) + s*cos(2*theta)\" }", mean_share(turning(2))});
  }
  std::vector<double> cube_x, cube_y;
  for (std::size_t k = 0; k < p.x.size(); ++k) {
    const double r2 = p.x[k] * p.x[k] + p.y[k] * p.y[k];
    cube_x.push_back(p.x[k] * r2);
    cube_y.push_back(p.y[k] * r2);
  }
  all.push_back({"position (cubic)", "force = { x = \"-k3*x*(x*x + y*y)\", y = \"-k3*y*(x*x + y*y)\" }", 0.5 * (Share({cube_x}, p.fx) + Share({cube_y}, p.fy))});
  const Contact contact = FindContact(p);
  const double ca = std::cos(contact.angle), sa = std::sin(contact.angle);
  all.push_back({fmt::format("position on one side: contact at {:.0f} degrees", contact.angle * 180 / kPi),
                 fmt::format("force = {{ x = \"-k*max({0:.3g}*x + {1:.3g}*y - c, 0)*({0:.3g} - mu*{1:.3g})\", y = \"-k*max({0:.3g}*x + {1:.3g}*y - c, 0)*({1:.3g} + mu*{0:.3g})\" }}  "
                             "# c = {2:.3g} m, mu: friction", ca, sa, contact.gap),
                 contact.share});
  return *std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.share < b.share; });
}

std::string FrequencyText(const CaseModel& model, const std::vector<double>& frequencies, std::size_t record) {
  const CaseRecord& r = model.data().records[record];
  const double speed = r.scenario.speed.Speed(0.5 * r.scenario.duration) / (2 * kPi);
  std::string text;
  for (double f : frequencies) {
    text += fmt::format("{}{:.1f} Hz", text.empty() ? "" : ", ", f);
    if (speed > 1 && std::abs(f / speed - std::round(f / speed)) < 0.04) text += fmt::format(" (order {:.0f})", std::round(f / speed));
  }
  return text;
}

}  // namespace

Unexplained Describe(const CaseModel& model, const FitResult& fit) {
  Unexplained u;
  const Worst any = FindWorst(model, fit, false), reading = FindWorst(model, fit, true);
  if (!any.target) return u;
  const CaseRecord& record = model.data().records[any.target->record];
  u.frequencies = FindPeaks(model, fit.residual).spectrum;
  double clamped = 0, free_running = 0;
  for (const Target& t : model.targets())
    (model.data().records[t.record].scenario.start == StartState::kClamped ? clamped : free_running) =
        std::max(TargetRatio(model, fit.residual, t),
                 model.data().records[t.record].scenario.start == StartState::kClamped ? clamped : free_running);
  u.block = clamped > 1.5 ? "coil or force" : "rotor or sensor";
  u.where = record.data.channels[any.target->channel].name;
  if (reading.target) {
    const CaseRecord& r = model.data().records[reading.target->record];
    const std::string channel = r.data.channels[reading.target->channel].name;
    const std::string plane = channel.substr(0, channel.find('.'));
    u.where = "plane " + plane + ", worst at " + channel;
    double best_share = 0;
    for (const CaseRecord& candidate : model.data().records) {
      const auto force = EstimateResidualForce(fit.hypothesis.rig, candidate.scenario, candidate.data);
      if (!force) continue;
      for (const auto& p : force->planes) {
        if (p.bearing != plane) continue;
        const Dependence d = FindDependence(*force, p);
        double square = 0;
        for (std::size_t k = 0; k < p.fx.size(); ++k) square += p.fx[k] * p.fx[k] + p.fy[k] * p.fy[k];
        if (d.share <= best_share) continue;
        best_share = d.share;
        u.dependence = fmt::format("{} ({:.0f} % of the missing force of {:.2g} N rms in {})", d.on, 100 * d.share,
                                   std::sqrt(square / static_cast<double>(p.fx.size())), candidate.data_file);
        u.formula = d.formula;
      }
    }
  }
  u.text = fmt::format("{} in {}: {:.1f} times the noise at {}{}; the error stands out at {}; it depends most on {}.", u.block,
                       record.data_file, any.ratio, record.data.channels[any.target->channel].name, reading.target ? "; " + u.where : "", FrequencyText(model, u.frequencies, any.target->record),
                       u.dependence.empty() ? "nothing that was tried" : u.dependence);
  return u;
}

namespace {

struct Library {
  std::string name, toml;
};

/// Records that any such rig can make.
std::vector<Library> FeasibleScenarios(const RigParameters& rig) {
  std::string axis, coil;
  for (const auto& b : rig.bearings) {
    if (axis.empty()) axis = b.Axes()[0];
    if (coil.empty()) coil = b.name + ".coil1";
  }
  const std::string head = fmt::format("rig = \"rig.toml\"\nrecord_rate = {}\nnoise = false\n", rig.controller.rate);
  const std::string tail = fmt::format("[[excitation]]\ntarget = \"{}\"\nport = \"force\"\nkind = \"chirp\"\nf0 = 5.0\nf1 = 1200.0\nstart = 0.02\nstop = 0.3\namplitude = 5.0\n", axis);
  return {
      {"slow roll at 5 Hz", "name = \"slow\"\nduration = 0.4\n" + head + "[speed]\nprofile = [[0.0, 31.4]]\n"},
      {"run-up to 250 Hz", "name = \"run-up\"\nduration = 0.4\n" + head + "[speed]\nprofile = [[0.0, 0.0], [0.4, 1570.0]]\n"},
      {"force chirp 5 to 1200 Hz at standstill", "name = \"chirp\"\nduration = 0.3\n" + head + tail},
      {"force chirp at 150 Hz speed", "name = \"chirp\"\nduration = 0.3\n" + head + "[speed]\nprofile = [[0.0, 942.0]]\n" + tail},
      {"reference steps of 60 um", "name = \"steps\"\nduration = 0.3\n" + head + fmt::format("[[excitation]]\ntarget = \"{}\"\nport = \"reference\"\nkind = \"step\"\nstart = 0.05\nstop = 0.2\namplitude = 6e-5\n", axis)},
      {"clamped rotor, current ramp to 5 A in one coil", "name = \"ramp\"\nduration = 0.2\n" + head + fmt::format("[start]\nstate = \"clamped\"\n[[excitation]]\ntarget = \"{}\"\nport = \"current\"\nkind = \"ramp\"\nstart = 0.02\nstop = 0.18\namplitude = 5.0\n", coil)},
  };
}

}  // namespace

std::string SeparatingRecord(const CaseModel& model, const Hypothesis& first, const Hypothesis& second) {
  std::string best = "none of the scenarios tried tells them apart";
  double most = 2;
  for (const Library& item : FeasibleScenarios(model.data().rig)) {
    try {
      Case c;
      c.file = item.name;
      c.rig = model.data().rig;
      CaseRecord r;
      r.scenario = ReadScenarioText(item.toml, item.name, c.rig);
      r.data.rate = r.scenario.record_rate;
      const auto rows = static_cast<std::size_t>(r.scenario.duration * r.scenario.record_rate);
      for (const auto& b : c.rig.bearings) {
        for (const auto& axis : b.Axes()) r.data.channels.push_back({axis, "m", std::vector<double>(rows, 0)});
        for (int j = 1; j <= b.coils(); ++j) r.data.channels.push_back({fmt::format("{}.i{}", b.name, j), "A", std::vector<double>(rows, 0)});
      }
      for (const Channel& ch : r.data.channels) r.quality.push_back({ch.name, "good", true, std::vector<char>(rows, 1), 0, 0});
      c.records.push_back(std::move(r));
      CaseModel trial(c);
      const NoiseFloor floor = FindFloor(trial, first);
      const auto other = trial.Predict(second);
      if (!other) continue;
      double difference = 0;
      for (const Target& t : trial.targets()) {
        double sum = 0;
        for (std::size_t k = t.first; k < t.first + t.count; ++k) sum += std::pow((*other)[k] - floor.clean[k], 2);
        difference = std::max(difference, std::sqrt(sum / static_cast<double>(t.count)) / t.floor);
      }
      if (difference > most) {
        most = difference;
        best = fmt::format("{} (their outputs differ by {:.1f} times the noise)", item.name, difference);
      }
    } catch (const InputError&) {
      continue;  // this rig cannot run that scenario
    }
  }
  return best;
}

}  // namespace ambrig
