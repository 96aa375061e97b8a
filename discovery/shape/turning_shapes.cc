/// Free shape of a force that turns with the shaft: a Fourier series over the shaft's angle, every
/// order forward and backward, as a `formula` of the rig file.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "discovery/shape/shape.h"
#include "effects/catalogue.h"

namespace ambrig {

namespace {

constexpr int kTurningOrders = 4, kAnglePoints = 73;
constexpr int kLawsOrder = 2;  // of the catalogue's law, forward: not penalised

/// One component of one order: the names of its table rows and its formulas.
struct TurningOrder {
  int order = 1;        // per turn
  bool forward = true;  // with the shaft, else against it
};

std::vector<TurningOrder> TurningOrders() {
  std::vector<TurningOrder> all;
  for (const bool forward : {true, false})
    for (int k = 1; k <= kTurningOrders; ++k) all.push_back({k, forward});
  return all;
}

bool IsOrderOfLaw(const TurningOrder& o) { return o.forward && o.order == kLawsOrder; }

EffectParameter OrderAmplitude(const TurningOrder& o, const char* part, double size) {
  EffectParameter p;
  p.name = fmt::format("{}{}{}", part, o.order, o.forward ? "" : "b");
  p.unit = "N";
  p.lo = -1e6;
  p.hi = 1e6;
  p.typical_lo = 0.1 * size;
  p.typical_hi = size;
  p.doc = fmt::format("order {}, {}", o.order, o.forward ? "forward" : "backward");
  return p;
}

/// Sums over all orders of (c + i s) exp(i order theta) + (cb + i sb) exp(-i order theta), whose
/// real part acts along x and whose imaginary part along y. One sine and one cosine an order: they
/// are most of the work.
std::pair<std::string, std::string> TurningFormulas() {
  std::string x, y;
  for (int k = 1; k <= kTurningOrders; ++k) {
    const auto name = [&](const char* part, bool forward) {
      return OrderAmplitude({k, forward}, part, 0).name;
    };
    const std::string c = name("c", true), s = name("s", true), cb = name("c", false),
                      sb = name("s", false), turned = k == 1 ? "theta" : fmt::format("{}*theta", k),
                      plus = k == 1 ? "" : " + ";
    x += fmt::format("{}({} + {})*cos({}) + ({} - {})*sin({})", plus, c, cb, turned, sb, s, turned);
    y += fmt::format("{}({} - {})*sin({}) + ({} + {})*cos({})", plus, c, cb, turned, s, sb, turned);
  }
  return {x, y};
}

}  // namespace

Shape TurningShape(const EffectInstance& named) {
  const double c = named.Value("c"), s = named.Value("s"), size = std::max(std::hypot(c, s), 1e-12);
  Shape out = FormulaShape(named, named.target);
  const std::vector<TurningOrder> orders = TurningOrders();
  const auto count = static_cast<Eigen::Index>(2 * orders.size());
  out.roughness = Eigen::MatrixXd::Zero(count, count);
  for (const TurningOrder& o : orders)
    for (const bool cosine : {true, false}) {
      const auto at = static_cast<Eigen::Index>(out.rows.size());
      const double of_law = cosine ? c : s;
      AddFormulaSize(out, OrderAmplitude(o, cosine ? "c" : "s", size),
                     IsOrderOfLaw(o) ? of_law : 0);
      if (!IsOrderOfLaw(o)) out.roughness(at, at) = o.order;
    }
  const auto [x, y] = TurningFormulas();
  out.effect.formulas = {{"force.x", x}, {"force.y", y}};
  out.step = Eigen::VectorXd::Constant(count, 0.3 * size);
  out.everywhere = true;
  for (int k = 0; k < kAnglePoints; ++k)
    out.u.push_back(2 * std::numbers::pi * k / (kAnglePoints - 1));
  out.value = [orders](const std::vector<double>& sizes, double u) {
    double sum = 0;
    for (std::size_t k = 0; k < orders.size(); ++k)
      sum += sizes[2 * k] * std::cos(orders[k].order * u) -
             (orders[k].forward ? 1 : -1) * sizes[2 * k + 1] * std::sin(orders[k].order * u);
    return sum;
  };
  out.u_name = "angle of the shaft";
  out.u_unit = "rad";
  out.value_name = "force along x";
  out.value_unit = "N";
  return out;
}

}  // namespace ambrig
