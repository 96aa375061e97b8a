#pragma once
/// The door to libode (Open Dynamics Engine, double precision): rigid bodies, contact joints, one
/// motor and hinges, in plain vectors. Everything in one inertial frame, SI units.
///
/// One Step(h) of ODE (its `dWorldStep`, a Dantzig LCP): with M the masses, J the constraint rows,
///   M (v⁺ - v) = h (f + Jᵀ λ),   J v⁺ + CFM λ = c,   bounds on λ,   x⁺ = x + h v⁺
/// Forces are those added since the last step; contacts live for one step.
#include <Eigen/Core>
#include <memory>

namespace ambrig {

inline constexpr int kOdeStatic = -1;  // the frame itself, as the second party of a joint

/// One contact point between body `one` and body `two` (or the frame).
struct OdeContact {
  int one = 0, two = kOdeStatic;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    // [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // into body `one`
  Eigen::Vector3d slide = Eigen::Vector3d::UnitY();   // direction of friction, across the normal
  double depth = 0;                                   // [m]
  double friction = 0;  // Coulomb's mu along `slide`; none across it [-]
  double erp = 0;       // share of the depth that one step takes back [-]
  double cfm = 0;       // [m/(N s)]: the row is  v_n + cfm N = erp depth / h
};

class OdeWorld {
 public:
  /// @throws std::runtime_error if the library is not of double precision.
  OdeWorld();
  ~OdeWorld();
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  /// `inertia` about the body's own axes [kg m2]. Without `gyroscopic` ODE leaves out -ω × (I ω).
  int AddBody(double mass, const Eigen::Vector3d& inertia, bool gyroscopic);
  /// Body `one` turns about z at `anchor` on body `two` (or the frame).
  void AddHinge(int one, int two, const Eigen::Vector3d& anchor);

  void SetPose(int body, const Eigen::Vector3d& place, const Eigen::Matrix3d& turn);
  void SetVelocity(int body, const Eigen::Vector3d& v);
  void SetTurning(int body, const Eigen::Vector3d& omega);
  Eigen::Vector3d Place(int body) const;
  Eigen::Matrix3d Turn(int body) const;
  Eigen::Vector3d Velocity(int body) const;
  Eigen::Vector3d Turning(int body) const;

  // For the next step only.
  void AddForce(int body, const Eigen::Vector3d& f);   // at the centre of mass [N]
  void AddTorque(int body, const Eigen::Vector3d& m);  // [N m]
  void AddContact(const OdeContact& contact);
  /// A motor that holds ω·axis of `body` at `speed` whatever torque that takes.
  void AddMotor(int body, const Eigen::Vector3d& axis, double speed);

  /// @throws std::runtime_error when ODE reports an error.
  void Step(double h);
  /// Warnings that ODE has given in this thread so far (its LCP solver's, as a rule).
  static long Warnings();

 private:
  struct Library;
  std::unique_ptr<Library> ode_;
};

}  // namespace ambrig
