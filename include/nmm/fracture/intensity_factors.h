#ifndef nmm_fracture_intensity_factors_h
#define nmm_fracture_intensity_factors_h

#include <nmm/covers/cover_system.h>
#include <nmm/covers/crack_tip.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <functional>
#include <vector>

namespace NMM
{
  /// What a crack tip is like under the load.
  struct IntensityFactors
  {
    /// Stress intensity factors [Pa m^(1/2)]: ahead of the tip
    /// sigma_22 = K_I (2 pi r)^(-1/2), sigma_12 = K_II (2 pi r)^(-1/2).
    double K_I = 0., K_II = 0.;
    /// T-stress [Pa]: the part of sigma_11 at the tip that is not singular.
    double T = 0.;
    /// Energy that the crack releases where it grows straight on, per area [J/m^2]:
    /// (K_I^2 + K_II^2) / E'.
    double energy_release_rate = 0.;
    /// Radius of the disk they were computed from [m].
    double radius = 0.;
    /// How far the intensity factors from smaller disks are from these, the largest
    /// difference [Pa m^(1/2)]: the error that comes from cells within the disk. What is wrong
    /// outside of it, or with all disks alike, is not seen.
    double spread = 0.;
  };


  /// Traction [Pa] on a crack face at x with the unit normal that points out of the solid.
  using FaceTraction =
    std::function<dealii::Tensor<1, 2>(const dealii::Point<2> &,
                                       const dealii::Tensor<1, 2> &)>;


  /// A force that the two faces of a crack exert on each other where they touch.
  struct ContactForce
  {
    /// Where they touch [m].
    dealii::Point<2> x;
    /// Unit normal of one of the faces there, out of the solid.
    dealii::Tensor<1, 2> normal;
    /// On the face with that normal, per unit thickness [N/m]. The opposite force acts on the
    /// other face.
    dealii::Tensor<1, 2> force;
  };


  /// u [m] at reference coordinates of an element.
  using ElementDisplacement =
    std::function<dealii::Tensor<1, 2>(unsigned int, const dealii::Point<2> &)>;

  /// du_i/dx_j [-] there.
  using ElementGradient =
    std::function<dealii::Tensor<2, 2>(unsigned int, const dealii::Point<2> &)>;


  /**
   * Intensity factors of a crack tip by interaction integrals in domain form, for each of several
   * disks about the tip, from any displacement.
   *
   * Let a be an elastic field without body force, singular at the tip (TipField),
   * with stress s^a and strain e^a, continued up to the faces of the crack, however these
   * bend. With a function q that is 1 near the tip and 0 outside the disk, sigma the stress
   * with initial stress, f the body force and t the traction on the faces, n
   * pointing out of the solid, and indices in the tip's frame,
   * @f[ P_j = \sigma_{kl}e^a_{kl}\delta_{1j} - \sigma_{ij}a_{i,1} - s^a_{ij}u_{i,1},
       \qquad P_{j,j} = f_ia_{i,1}, @f]
   * @f[ I = \lim_{\rho\to0}\int_{r=\rho}P_jm_j\,ds
         = -\int_A (P_jq_{,j} + q f_ia_{i,1})\,dA
         + \int_{\mathrm{faces}} q P_jn_j\,ds. @f]
   * On the faces derivatives of u appear along the face only,
   * @f[ P_jn_j = n_1\sigma^0_{kl}e^a_{kl} - t_ia_{i,1} + s^a_{i2}\,\partial_su_i, @f]
   * s being the direction with the solid on its left. The last term is integrated by parts, so
   * that I is a bounded functional of u and converges with the square of the energy error:
   * @f[ \int q s^a_{i2}\,\partial_su_i\,ds
       = -\int \partial_s(q s^a_{i2})\,(u_i-u_i^{\mathrm{tip}})\,ds. @f]
   * The displacement of the tip changes nothing but makes the T-stress's integral
   * exist. On straight faces without traction all of this vanishes and is skipped. A body force
   * is divided: with its value f^0 at the tip,
   * @f$ \int_A q f^0_ia_{i,1} = -\int_A q_{,1}f^0_ia_i
       + \int_{\mathrm{faces}} q f^0_i a_i n_1@f$, which has no singular integrand.
   *
   * Then K_I = E' I / 2 with the field of unit K_I, likewise K_II, and with the
   * point force
   * @f$ T = E' I + \sigma_{22} + \sigma^0_{11} - \nu'\sigma^0_{22}@f$, sigma_22 being minus the
   * normal pressure on the faces at the tip and nu' = (3 - kappa) / (1 + kappa).
   *
   * q is a polynomial of degree 7 in r between an inner and the outer radius, with three
   * continuous derivatives. Element rules have the degree 10: their own error is 1e-7 of K
   * with ten cells and 1e-8 with twenty along the radius.
   *
   * Where faces touch, t is not a function but forces of single points, as in the equilibrium of
   * u, and their sum stands for the integral of t. In the first cells at the tip these are as
   * wrong as stresses are there, and covers are not divided any more. So the traction is taken to
   * be uniform in the part w = (1 - s^2)^2, s = r / rho, of all forces, with rho = 0.2 of the
   * radius. Its resultant follows from the forces farther out, since the integral of w is 7 times
   * that of s^2 w, and is 8 / 15 rho times the traction; the integral of w r^(-1/2) is that of a
   * force at r = (3/8)^2 rho.
   *
   * Limits: small displacements; initial stress is uniform in the region; no inertia, no
   * inelastic strain within the disk; nothing but this crack in the disk
   * (CrackTip::free_radius).
   *
   * Sources: M. Stern, E. Becker, R. Dunham, Int. J. Fract. 12 (1976), 359-368; J. Yau, S. Wang, H.
   * Corten, J. Appl. Mech. 47 (1980), 335-341; the form for bent cracks is derived here.
   *
   * @p radii of the disks [m]. @p face_traction acts on the faces besides the pressures of
   * the problem; empty: none. Of @p contact_forces each rank gives its own. Collective.
   * @throws InputError for a radius larger than the tip's free radius.
   */
  std::vector<IntensityFactors>
  interaction_integrals(const CoverSystem               &covers,
                        const ElasticityProblem         &problem,
                        const CrackTip                  &tip,
                        const std::vector<double>       &radii,
                        const ElementDisplacement       &displacement,
                        const ElementGradient           &gradient,
                        const FaceTraction              &face_traction  = {},
                        const std::vector<ContactForce> &contact_forces = {});


  /**
   * Intensity factors of a tip from five disks: those of the largest one, with the spread
   * of all. @p largest_radius [m]; 0 stands for 0.9 times the tip's free radius.
   * @p contact_forces as in interaction_integrals(). Collective.
   */
  IntensityFactors
  compute_intensity_factors(
    const DisplacementField         &field,
    const ElasticityProblem         &problem,
    const CrackTip                  &tip,
    double                           largest_radius = 0.,
    const std::vector<ContactForce> &contact_forces = {});
} // namespace NMM

#endif
