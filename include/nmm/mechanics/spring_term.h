#ifndef nmm_mechanics_spring_term_h
#define nmm_mechanics_spring_term_h

#include <nmm/mechanics/force_term.h>

#include <optional>
#include <vector>

namespace NMM
{
  /// An elastic spring between two material points of a solid.
  struct Spring
  {
    /// Its ends in the reference configuration, within the solid [m].
    dealii::Point<2> start, end;
    /// Force per elongation and per unit thickness, at least 0 [N/m^2].
    double stiffness = 0.;
    /// Length without force [m]; if not given, that in the reference configuration. The ends may
    /// be the same point of the plane only if it is 0.
    std::optional<double> natural_length;
  };


  /**
   * The force term of springs. With the vector d from one end to the other, the stiffness k and the
   * natural length L a spring stores
   * @f$ \psi(d) = \tfrac12 k\,(|d| - L)^2 @f$, an energy of conditions. The forces
   * @f$ \pm\partial\psi/\partial d = \pm k\,(1 - L/|d|)\,d @f$ on both ends turn with the spring.
   * Conserving forces are the discrete gradient of the energy (Gonzalez, J. Nonlinear Sci. 6 (1996)
   * 449, eq. (35)),
   * @f[ f = 2\,\frac{\psi(d_1) - \psi(d_0)}{|d_1|^2 - |d_0|^2}\,\bar d
   *       = k \left(1 - \frac{2L}{|d_0| + |d_1|}\right) \bar d, \qquad
   *     \bar d = \tfrac12 (d_0 + d_1), @f]
   * whose work is the change of the energy, and which exert no moment in the mean position.
   *
   * In small kinematics the energy is expanded about the reference configuration to second order,
   * with the stiffness against rotation that comes from the force in that configuration.
   *
   * A spring of an absent block exerts no forces. Lifetime: the layout must outlive this object, the
   * cover system is needed by the constructor only.
   */
  class SpringTerm : public ForceTerm
  {
  public:
    /// Collective.
    /// @throws InputError for an end outside the solid, a negative stiffness or natural length, and
    /// ends at the same point with a natural length above 0.
    SpringTerm(const CoverSystem  &covers,
               const ModelLayout  &layout,
               std::vector<Spring> springs,
               Kinematics          kinematics = Kinematics::finite);

    std::vector<Unknowns>
    couplings() const override;

    ForceProperties
    properties() const override;

    /// A spring that has shrunk to a point has no direction: unless its natural length is 0, the
    /// deformation is not admissible.
    Deformation
    assemble(const Trial &trial, AssembledForces &sum) override;

    void
    set_presence(const Presence &presence) override;

    /// Force of each spring at the displacements @p u, positive in tension [N/m]. Collective.
    std::vector<double>
    forces(const Vector &u) const;

  private:
    std::vector<Spring> springs;
    Kinematics          kinematics;
    /// For each spring, the vector between its ends and its value in the reference configuration.
    std::vector<MaterialVector>       vectors;
    std::vector<dealii::Tensor<1, 2>> at_rest;
    std::vector<bool>                 is_absent;
  };
} // namespace NMM

#endif
