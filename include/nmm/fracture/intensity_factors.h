#ifndef nmm_fracture_intensity_factors_h
#define nmm_fracture_intensity_factors_h

#include <nmm/covers/cover_system.h>
#include <nmm/covers/crack_tip.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_rule_builder.h>

#include <functional>
#include <unordered_map>
#include <vector>

namespace NMM
{
  /// The parameters of the stress field at a crack tip.
  struct IntensityFactors
  {
    /// Stress intensity factor of the opening mode [Pa m^(1/2)]: ahead of the tip
    /// sigma_22 = K_I (2 pi r)^(-1/2) in the tip's frame.
    double K_I = 0.;
    /// Stress intensity factor of the sliding mode [Pa m^(1/2)]: ahead of the tip
    /// sigma_12 = K_II (2 pi r)^(-1/2) in the tip's frame.
    double K_II = 0.;
    /// T-stress [Pa]: the part of sigma_11 at the tip that is not singular. NaN where regions with
    /// different initial stress meet at the tip.
    double T = 0.;
    /// Energy that the crack releases per area if it grows straight on [J/m^2]:
    /// (K_I^2 + K_II^2) / E'.
    double energy_release_rate = 0.;
    /// Radius of the disk from which the factors were computed [m].
    double radius = 0.;
    /// Largest difference of K_I and of K_II from those of smaller disks [Pa m^(1/2)]. It
    /// estimates the error that comes from cells within the disk. Errors from outside of the
    /// disk, and errors that all disks share, do not show.
    double spread = 0.;
  };


  /// Traction on a crack face [Pa], a function of the point x [m] and of the unit normal there
  /// that points out of the solid.
  using FaceTraction =
    std::function<dealii::Tensor<1, 2>(const dealii::Point<2> &,
                                       const dealii::Tensor<1, 2> &)>;


  /// A force that the two faces of a crack exert on each other at a point of contact.
  struct ContactForce
  {
    /// The point of contact [m].
    dealii::Point<2> x;
    /// Unit normal of one of the faces, pointing out of the solid [-].
    dealii::Tensor<1, 2> normal;
    /// Force on the face with that normal, per unit thickness [N/m]. The opposite force acts on
    /// the other face.
    dealii::Tensor<1, 2> force;
  };


  /// Displacement u [m], a function of the element and of reference coordinates in its cell [-].
  using ElementDisplacement =
    std::function<dealii::Tensor<1, 2>(unsigned int, const dealii::Point<2> &)>;

  /// Displacement gradient du_i/dx_j [-], a function of the element and of reference coordinates
  /// in its cell [-].
  using ElementGradient =
    std::function<dealii::Tensor<2, 2>(unsigned int, const dealii::Point<2> &)>;


  /// What acts on a crack beside the loads of the problem; all of it may be left out.
  struct TipLoading
  {
    /// Traction on the faces, besides the pressures of the problem.
    FaceTraction face_traction = {};
    /// Forces where the faces touch; each rank gives its own.
    std::vector<ContactForce> contact_forces = {};
    /// Acceleration d^2u/dt^2 [m/s^2] of a solid in motion, a function of the element and of
    /// reference coordinates in its cell.
    ElementDisplacement acceleration = {};
  };


  /// Rules on the elements that curves cut, of the degree that interaction integrals need. Whoever
  /// computes intensity factors of several states of a solid keeps them, since they take longer
  /// than the integrals.
  class DiskRules
  {
  public:
    DiskRules();

    /// The rule of an element of @p mesh, which must be the same mesh in all calls.
    const dealii::Quadrature<2> &
    rule(const ManifoldMesh &mesh, unsigned int element);

  private:
    dealii::Quadrature<2>                                   whole_rule;
    std::unordered_map<unsigned int, dealii::Quadrature<2>> rules;
    ElementRuleBuilder                                      builder;
  };


  /**
   * Whether the stress at a tip grows like the inverse root of the distance, so that it has intensity
   * factors: whether all materials around it have the same elasticity. Where they differ, the
   * exponent is another one, or a complex number if the crack runs along the interface. Density,
   * toughness and initial stress may differ.
   */
  bool
  has_intensity_factors(const CrackTip          &tip,
                        const PhysicalMesh      &physical_mesh,
                        const ElasticityProblem &problem);


  /**
   * Intensity factors of a crack tip by interaction integrals in domain form, for each of several
   * disks about the tip. The displacement can be any function.
   *
   * Let a be an elastic field without body force that is singular at the tip (TipField),
   * with stress s^a and strain e^a. It is continued up to the faces of the crack, also where these
   * bend. Let q be a function that is 1 near the tip and 0 outside the disk, sigma the stress
   * including initial stress, f the body force, t the traction on the faces, and n the normal
   * that points out of the solid. With indices in the tip's frame,
   * @f[ P_j = \sigma_{kl}e^a_{kl}\delta_{1j} - \sigma_{ij}a_{i,1} - s^a_{ij}u_{i,1},
       \qquad P_{j,j} = f_ia_{i,1}, @f]
   * @f[ I = \lim_{\rho\to0}\int_{r=\rho}P_jm_j\,ds
         = -\int_A (P_jq_{,j} + q f_ia_{i,1})\,dA
         + \int_{\mathrm{faces}} q P_jn_j\,ds. @f]
   * On the faces only derivatives of u along the face appear,
   * @f[ P_jn_j = n_1\sigma^0_{kl}e^a_{kl} - t_ia_{i,1} + s^a_{i2}\,\partial_su_i, @f]
   * where s is the direction with the solid on its left. The last term is integrated by parts, so
   * that I is a bounded functional of u and converges with the square of the energy error:
   * @f[ \int q s^a_{i2}\,\partial_su_i\,ds
       = -\int \partial_s(q s^a_{i2})\,(u_i-u_i^{\mathrm{tip}})\,ds. @f]
   * Subtracting the displacement of the tip does not change the result, but the integral for the
   * T-stress exists only with it. On straight faces without traction these terms vanish and are
   * skipped. The body force is split into its value f^0 at the tip and the rest. For the former,
   * @f$ \int_A q f^0_ia_{i,1} = -\int_A q_{,1}f^0_ia_i
       + \int_{\mathrm{faces}} q f^0_i a_i n_1@f$, which has no singular integrand.
   *
   * Then K_I = E' I / 2 with the field of unit K_I, and likewise for K_II. With the field of the
   * point force
   * @f$ T = E' I + \sigma_{22} + \sigma^0_{11} - \nu'\sigma^0_{22}@f$, where sigma_22 is minus
   * the normal pressure on the faces at the tip and nu' = (3 - kappa) / (1 + kappa).
   *
   * q is a polynomial of degree 7 in r between an inner and the outer radius, with three
   * continuous derivatives. Element rules have the degree 10. Their own error is 1e-7 of K
   * with ten cells along the radius, and 1e-8 with twenty.
   *
   * Where faces are in contact, t consists of forces at single points, as in the equilibrium of
   * u, and sums over these points replace the integrals of t. In the first cells at the tip these
   * forces are as inaccurate as stresses are there, and the crack no longer splits the covers.
   * Therefore the part w = (1 - s^2)^2 of all forces, with s = r / rho and rho = 0.2 of the
   * radius, is replaced by that of a uniform traction. Its resultant follows from the forces
   * farther out, since the integral of w is 7 times that of s^2 w. The resultant is 8 / 15 rho
   * times the traction. It is applied at r = (3/8)^2 rho, where a single force has the same
   * integral of w r^(-1/2).
   *
   * Where regions with different initial stress meet at the tip, @f$\sigma^0@f$ is that of the
   * region CrackTip::region, and D is that of another region minus @f$\sigma^0@f$. Without D the
   * stress @f$\sigma-D@f$ satisfies the equations above with the loads t - D n on the faces
   * and with the line force @f$-(D^+n^++D^-n^-)@f$ on interfaces, n pointing out of the region of
   * each side. The elasticity is the same on both sides, so that P_j n_j jumps on an interface by
   * the work of this line force on a_{,1} only, though du/dx jumps, too. Thus I gets
   * @f[ I_D = \int_{\mathrm{faces}} q D_{ij}n_ja_{i,1}\,ds
             + \int_{\mathrm{interfaces}} q(D^+_{ij}n^+_j+D^-_{ij}n^-_j)a_{i,1}\,ds. @f]
   * The integrand grows like r^(-1/2) for K. For T it grows like 1/r: in general sigma_11 has a
   * logarithm there, and it is another one in each region, so that T is not defined.
   *
   * Where the initial stress varies within a region, @f$\sigma^0@f$ is its value at the tip, and D
   * is the difference from it at x. Then sigma - D satisfies the equations above with the body
   * force f + div D and the traction t - D n, so that I gets
   * @f$-\int_A q\,D_{ij,j}a_{i,1} + \int q D_{ij}n_ja_{i,1}\,ds@f$ on faces and interfaces. By Gauss'
   * theorem this is
   * @f[ I_D = \int_A D_{ij}\,(q a_{i,1})_{,j}\,dA, @f]
   * in which neither derivatives of the stress nor edges appear, so that it may also jump or kink in
   * a region away from the tip. The integrand grows like r^(-1/2) for K and like 1/r for T, since D
   * is 0 at the tip.
   *
   * In motion the inertia -rho d^2u/dt^2 is a part of the body force; at the tip it is left in the
   * part that varies. The factors are those of the crack as it stands still.
   *
   * Limits: displacements are small, and initial stress is continuous in each region at the tip.
   * Within the disk there is no inelastic strain, no viscous stress, and no curve but this crack
   * (CrackTip::free_radius) and interfaces through its tip between materials of the same elasticity
   * (has_intensity_factors()), where traction and displacement are continuous.
   *
   * Sources: M. Stern, E. Becker, R. Dunham, Int. J. Fract. 12 (1976), 359-368; J. Yau, S. Wang, H.
   * Corten, J. Appl. Mech. 47 (1980), 335-341; the form for bent cracks is derived here.
   *
   * @p radii are the radii of the disks [m]; @p rules may be null. Returns the factors of each
   * disk, with a spread of 0. Collective.
   * @throws InputError for a radius larger than the tip's free radius.
   */
  std::vector<IntensityFactors>
  interaction_integrals(const CoverSystem         &covers,
                        const ElasticityProblem   &problem,
                        const CrackTip            &tip,
                        const std::vector<double> &radii,
                        const ElementDisplacement &displacement,
                        const ElementGradient     &gradient,
                        const TipLoading          &loading = {},
                        DiskRules                 *rules   = nullptr);


  /**
   * Intensity factors of a tip from five disks. The factors are those of the largest disk, and
   * IntensityFactors::spread compares all of them. @p largest_radius is the radius of that disk
   * [m]; 0 stands for 0.9 times the tip's free radius. @p rules may be null. Collective.
   */
  IntensityFactors
  compute_intensity_factors(const DisplacementField &field,
                            const ElasticityProblem &problem,
                            const CrackTip          &tip,
                            double                   largest_radius = 0.,
                            const TipLoading        &loading        = {},
                            DiskRules               *rules          = nullptr);
} // namespace NMM

#endif
