#include "control/position/c_code/c_code.h"

#include <fmt/format.h>

#include <sstream>

#include "control/position/position_controller.h"
#include "core/base/errors.h"

namespace ambrig {

namespace {

constexpr const char* kHelpers = R"(
/* y += sign A x, sign 1 or -1; A by columns, each row summed column by column in blocks: the order of the
   simulated controller. */
static void add_product(double sign, int rows, int columns, const double *A, const double *x, double *y) {
  const int block = columns < 128 || rows == 1 ? columns : rows * 8 < 32000 ? 16 : 4;
  int i, j, j0;
  for (j0 = 0; j0 < columns; j0 += block)
    for (i = 0; i < rows; ++i) {
      double sum = 0;
      for (j = j0; j < columns && j < j0 + block; ++j) sum += A[j * rows + i] * x[j];
      y[i] += sign * sum;
    }
}

static void product(int rows, int columns, const double *A, const double *x, double *y) {
  int i;
  for (i = 0; i < rows; ++i) y[i] = 0;
  add_product(1, rows, columns, A, x, y);
}

static double clamped(double value, double limit) {
  return value < -limit ? -limit : limit < value ? limit : value;
}

/* Place of |omega| among ascending speeds: value = (1 - weight) v[low] + weight v[low + 1]. */
static int locate(int points, const double *speeds, double omega, double *weight) {
  const double w = fabs(omega);
  int above = 0;
  *weight = 0;
  if (points < 2 || w <= speeds[0]) return 0;
  while (above < points && speeds[above] <= w) ++above;
  if (above == points) {
    *weight = 1;
    return points - 2;
  }
  *weight = (w - speeds[above - 1]) / (speeds[above] - speeds[above - 1]);
  return above - 1;
}

/* The matrices of two speeds, of which `all` holds one behind the other. */
static void mix(int numbers, const double *all, int low, double weight, double *out) {
  const double *a = all + low * numbers, *b = a + numbers;
  int k;
  for (k = 0; k < numbers; ++k) out[k] = (1 - weight) * a[k] + weight * b[k];
}

/* A x = b by Gauss's elimination with row pivots, A by columns, both overwritten; x in b. */
static void solve(int n, double *A, double *b) {
  int i, j, k;
  for (k = 0; k < n; ++k) {
    int pivot = k;
    for (i = k + 1; i < n; ++i)
      if (fabs(A[k * n + i]) > fabs(A[k * n + pivot])) pivot = i;
    for (j = k; j < n; ++j) {
      const double t = A[j * n + k];
      A[j * n + k] = A[j * n + pivot];
      A[j * n + pivot] = t;
    }
    {
      const double t = b[k];
      b[k] = b[pivot];
      b[pivot] = t;
    }
    for (i = k + 1; i < n; ++i) {
      const double l = A[k * n + i] / A[k * n + k];
      for (j = k; j < n; ++j) A[j * n + i] -= l * A[j * n + k];
      b[i] -= l * b[k];
    }
  }
  for (k = n - 1; k >= 0; --k) {
    for (j = k + 1; j < n; ++j) b[k] -= A[j * n + k] * b[j];
    b[k] /= A[k * n + k];
  }
}
)";

constexpr const char* kInterface = R"(
int ambrig_controller_open(ambrig_controller *c) {
  static const char *const names[] = {NAMES};
  uint32_t k;
  (void)solve;
  (void)mix;
  (void)locate;
  (void)product;
  (void)clamped;
  if (c->axes != AXES) return ambrig_fail(c, "made for another number of axes");
  for (k = 0; k < c->axes; ++k)
    if (strcmp(c->axis_name[k], names[k]) != 0) return ambrig_fail(c, "made for axes of other names");
  return 0;
}

int ambrig_controller_hold(ambrig_controller *c) {
  part1_hold(c->force, c->position, c->reference);
  return 0;
}

int ambrig_controller_step(ambrig_controller *c) {
  part1_step(c->position, c->reference, c->excitation, c->speed, c->force);
  return 0;
}

int ambrig_controller_track(ambrig_controller *c) {
  part1_track(c->position, c->reference, c->speed, c->force);
  return 0;
}
)";

std::string Replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
  return text;
}

/// `title` line by line inside a comment that it cannot end.
std::string Comment(const std::string& title) {
  std::istringstream lines(Replaced(title, "*/", "* /"));
  std::string out = "/*";
  for (std::string line; std::getline(lines, line);) out += " " + line + "\n *";
  return out + "/\n";
}

}  // namespace

std::string CNumber(double value) {
  if (value == kInfinity) return "HUGE_VAL";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string CCode::NextPart() const { return fmt::format("part{}", parts_ + 1); }

std::string CCode::NewPart() { return fmt::format("part{}", ++parts_); }

void CCode::Add(const std::string& part, const std::string& text) {
  text_ += Replaced(text, "$", part);
}

void CCode::Constant(const std::string& part, const std::string& name,
                     const std::vector<double>& values) {
  std::string line = fmt::format("static const double {}_{}[] = {{", part, name);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::string number = CNumber(values[k]) + (k + 1 < values.size() ? "," : "");
    if (line.size() + number.size() > 115) {
      text_ += line + "\n";
      line = "   ";
    }
    line += (line.ends_with('{') ? "" : " ") + number;
  }
  text_ += line + (values.empty() ? "0" : "") + "};\n";  // C has no empty arrays
}

void CCode::Constant(const std::string& part, const std::string& name,
                     const Eigen::MatrixXd& matrix) {
  Constant(part, name, std::vector<double>(matrix.data(), matrix.data() + matrix.size()));
}

void CCode::Constants(const std::string& part, const std::string& name,
                      const std::vector<Eigen::MatrixXd>& matrices) {
  std::vector<double> all;
  for (const Eigen::MatrixXd& m : matrices) all.insert(all.end(), m.data(), m.data() + m.size());
  Constant(part, name, all);
}

void CCode::Define(const std::string& part, const std::string& name, long value) {
  text_ += fmt::format("#define {}_{} {}\n", part, name, value);
}

void CCode::Define(const std::string& part, const std::string& name, double value) {
  text_ += fmt::format("#define {}_{} ({})\n", part, name, CNumber(value));
}

void PositionController::WriteC(CCode&) const {
  throw InputError("this kind of controller cannot be written as C");
}

std::string ControllerInC(const PositionController& controller,
                          const std::vector<std::string>& axes, const std::string& title) {
  CCode parts;
  controller.WriteC(parts);
  std::string names;
  for (const std::string& name : axes) names += (names.empty() ? "\"" : ", \"") + name + "\"";
  std::string text = Comment(title) + "#include <math.h>\n\n#include \"ambrig_controller.h\"\n\n" +
                     "AMBRIG_CONTROLLER_LIBRARY\n" + kHelpers + "\n" + parts.text();
  return text + Replaced(Replaced(kInterface, "NAMES", names), "AXES", std::to_string(axes.size()));
}

}  // namespace ambrig
