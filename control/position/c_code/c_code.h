#pragma once
/// Writing a controller as C99 (`ambrig export --controller-c`): one source behind
/// control/external/ambrig_controller.h that computes, period by period, the bits
/// that the simulated controller computes: same constants, same operations in the same order
/// (matrix products as Eigen does them).
///
/// Every class of controllers writes a part: static data and the functions
///
///   static void PART_hold(const double *force, const double *y, const double *r)
///   static void PART_step(const double *y, const double *r, const double *excitation,
///                         double omega, double *f)
///   static void PART_track(const double *y, const double *r, double omega, const double *f)
///
/// What hold and track solve for (linear systems) agrees with the simulated one to rounding;
/// zero is zero.
#include <Eigen/Dense>
#include <string>
#include <vector>

namespace ambrig {

class PositionController;

class CCode {
 public:
  /// A name for the next part: "part1", "part2", ...
  std::string NewPart();
  /// The name that the next call will give.
  std::string NextPart() const;
  /// Text as it stands; `$` becomes the part's name.
  void Add(const std::string& part, const std::string& text);
  /// static const double PART_name[] = {...}; matrices by columns.
  void Constant(const std::string& part, const std::string& name,
                const std::vector<double>& values);
  void Constant(const std::string& part, const std::string& name, const Eigen::MatrixXd& matrix);
  /// Several matrices of one size, one behind the other.
  void Constants(const std::string& part, const std::string& name,
                 const std::vector<Eigen::MatrixXd>& matrices);
  /// #define PART_name value
  void Define(const std::string& part, const std::string& name, long value);
  void Define(const std::string& part, const std::string& name, double value);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  int parts_ = 0;
};

/// A number that a C compiler reads as exactly this one.
std::string CNumber(double value);

/// The whole source for a controller of `axes`; `title`: lines of its first comment.
/// @throws InputError for a controller that cannot be written.
std::string ControllerInC(const PositionController& controller,
                          const std::vector<std::string>& axes, const std::string& title);

}  // namespace ambrig
