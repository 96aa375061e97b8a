#pragma once
/// The magnetic circuit of any stator with ideal iron: poles of any number, angle, area and gap, a
/// winding matrix poles x coils, permanent magnets in the poles or between the parts of the iron.
///
///   R_p = g_p/(mu0 A_p) + R_m,p                    pole: its gap and a magnet in it      [1/H]
///   g_p = g0_p - d_p · r,  d_p a unit vector       shaft at r = (x, y, z), stator axes   [m]
///   phi_p R_p = Σ_c N_pc i_c + F_p + U_part        flux out of the stator into the rotor [Wb]
///   phi_m R_m = F_m + U_from - U_to                a magnet between two parts, or one and the
///                                                  rotor
///   Σ of the fluxes that leave a part = 0          U of the rotor is 0, those of the parts float
///   λ = Nᵀ phi + L_l i                             linkages                              [Wb]
///   f = Σ phi_p²/(2 mu0 A_p) d_p                   force on the rotor                    [N]
///
/// A part is iron that no gap divides: one of a heteropolar stator, one for each plane of a
/// homopolar one, one for each side of an axial one. Leakage inductances are the stator's
/// (stator_geometry.h). Source: docs/theory/stators.md.
#include <Eigen/Dense>
#include <array>
#include <vector>

namespace ambrig {

inline constexpr int kMostPoles = 32;
inline constexpr int kMostWindings = 24;  // coils of a network

using PoleVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostPoles, 1>;
using WindingMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostWindings + 1, kMostWindings + 1>;
/// Rows: poles; columns: coils, then the magnets.
using PoleMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostPoles, kMostWindings + 1>;

struct NetworkPole {
  std::array<double, 3> direction{1, 0, 0};  // d, towards the pole
  double area = 0;                           // [m2]
  double gap = 0;                            // rotor centred [m]
  int part = 0;
  double mmf = 0, reluctance = 0;  // of a magnet in the pole [A], [1/H]
};

struct NetworkMagnet {
  static constexpr int kRotor = -1;
  int from = 0, to = kRotor;  // parts
  double mmf = 0, reluctance = 0;
};

/// Fluxes of the poles as linear functions of (i, 1), at one place of the shaft.
struct NetworkFlux {
  PoleMatrix phi;               // [Wb/A], last column [Wb]
  std::array<PoleMatrix, 3> d;  // its derivatives along x, y, z [1/m]; empty when not asked for
};

class PoleNetwork {
 public:
  /// `turns`: poles x coils, signed. @throws std::logic_error for sizes that do not fit.
  PoleNetwork(std::vector<NetworkPole> poles, Eigen::MatrixXd turns,
              std::vector<NetworkMagnet> magnets = {});

  int poles() const { return static_cast<int>(poles_.size()); }
  int coils() const { return static_cast<int>(turns_.cols()); }
  bool has_magnets() const { return has_magnets_; }
  const NetworkPole& pole(int p) const { return poles_[static_cast<std::size_t>(p)]; }
  const Eigen::MatrixXd& turns() const { return turns_; }
  /// Σ |N_pc| over the poles.
  double TurnsOf(int coil) const { return turns_of_[coil]; }
  double SmallestGap() const;

  NetworkFlux FluxAt(const Eigen::Vector3d& r, bool derivatives = false) const;
  /// Nᵀ phi of the coils: inductances without leakage [H], last column the magnets' linkages [Wb].
  WindingMatrix Linkage(const PoleMatrix& phi) const;
  /// Of pole fluxes [N].
  Eigen::Vector3d Force(const PoleVector& phi) const;
  Eigen::Vector3d Force(const Eigen::Vector3d& r, const Eigen::VectorXd& current) const;
  /// dF/di, 3 x coils [N/A].
  Eigen::Matrix<double, 3, Eigen::Dynamic> ForceOfCurrent(const Eigen::Vector3d& r,
                                                          const Eigen::VectorXd& current) const;
  /// dF/dr at constant current [N/m]; positive pulls away from the centre.
  Eigen::Matrix3d NegativeStiffness(const Eigen::Vector3d& r, const Eigen::VectorXd& current) const;
  /// dλ/dr at constant current, coils x 3 [Wb/m]: (dF/di)ᵀ.
  Eigen::Matrix<double, Eigen::Dynamic, 3> LinkageOfPlace(const Eigen::Vector3d& r,
                                                          const Eigen::VectorXd& current) const;

 private:
  std::vector<NetworkPole> poles_;
  Eigen::MatrixXd turns_;
  Eigen::VectorXd turns_of_;
  std::vector<NetworkMagnet> magnets_;
  int parts_ = 0;
  bool has_magnets_ = false;
};

}  // namespace ambrig
