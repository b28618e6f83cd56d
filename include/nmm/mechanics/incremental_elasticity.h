#ifndef nmm_mechanics_incremental_elasticity_h
#define nmm_mechanics_incremental_elasticity_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <functional>
#include <memory>
#include <vector>

namespace NMM
{
  /**
   * The step-by-step kinematics of the paper (and of Shi's method): a load is
   * put on in small steps, each of which is *one* linear problem on the current
   * geometry x = X + u,
   * @f[ \int B^T C B\,da\;\Delta u = f(t_{n+1}) - \int B^T \sigma_n\,da, @f]
   * with the stress carried along as the initial stress of eq. (9) and the
   * stiffness (7) without a geometric part. After the step
   * @f[ \sigma_{n+1} = R\,(\sigma_n + C:\Delta\varepsilon)\,R^T, \quad
   *     x \leftarrow x + \Delta u, @f]
   * R being the rotation in I + grad(du) (polar decomposition), as a rotated
   * block must rotate its stress.
   *
   * Geometry: gradients on x are those on X times F^-1, areas those on X times
   * det F, at the quadrature points of the reference configuration, which is cut
   * once. Displacement conditions and ties are Nitsche's terms on the current
   * geometry; what a step misses of them is made up for in the next.
   *
   * What it costs: the displacement of a step is a straight line, so that a block
   * turned by theta in n steps grows by the factor (1 + theta^2/n^2)^(n/2), and the
   * error is of first order in the step. FiniteElasticity has neither. The
   * law is linear between the rate of stress and strain, whatever the material's
   * law; for small strains that agrees with St. Venant-Kirchhoff.
   *
   * Lifetime: all arguments of the constructor must outlive this object.
   */
  class IncrementalElasticity
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// @throws InputError and NumericalFailure as StaticElasticity; of a block that
    /// floats freely not if it @p may_float (dynamics).
    IncrementalElasticity(const CoverSystem                       &covers,
                          const QuadratureCollection              &quadrature,
                          const dealii::AffineConstraints<double> &constraints,
                          const ElasticityProblem                 &problem,
                          bool may_float = false);
    ~IncrementalElasticity();

    /**
     * One step, to the loads and prescribed displacements times
     * @p load_factor. Follower pressure acts on the geometry at the
     * beginning of the step. Returns the largest displacement of a cover in
     * the step [m].
     * @throws NumericalFailure if an element is turned inside out or the
     * system is singular.
     */
    double
    step(double load_factor);

    struct StepResult
    {
      /// Largest displacement of a cover [m].
      double largest_displacement = 0.;
      bool   is_taken             = false;
    };

    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    /// The same with equations of the caller's: @p solve is handed stiffness
    /// and r = internal forces - loads at the beginning of the step and finds minus
    /// the displacement of the step (dynamics adds inertia to both).
    double
    step(double                                         load_factor,
         const std::function<void(const Matrix &stiffness,
                                  const Vector &residual,
                                  Vector       &correction)> &solve);

    /**
     * The same, unless a cover would move by more than @p max_displacement [m]:
     * then nothing changes, and a smaller step is to be tried. Without @p solve
     * the static step.
     */
    [[nodiscard]] StepResult
    try_step(double                                         load_factor,
             double                                         max_displacement,
             const std::function<void(const Matrix &stiffness,
                                      const Vector &residual,
                                      Vector       &correction)> &solve = {});

    /// All that steps change.
    struct State
    {
      /// Owned unknowns [m].
      Vector solution;
      /// Stresses at quadrature points, and at points of displacement conditions and ties [Pa].
      std::vector<dealii::SymmetricTensor<2, 2>> stress, weak_stress;
      double                                     work_of_loads = 0.;
    };

    State
    state() const;

    /// Continue from @p state, one of this object or of an equal one.
    void
    restore(const State &state);

    /// Strain energy of the stress on the current geometry, by the law of small strain, initial
    /// stress included [J/m].
    double
    strain_energy() const;

    /// Done in all steps by loads that keep their direction, gravity, body force,
    /// tractions and point forces [J/m].
    double
    work_of_loads() const;

    /// Sum of all steps [m], locally relevant.
    const Vector &
    solution() const;

    /// Cauchy stress at the quadrature points of owned elements, one element
    /// after the other in the order of the rules' points [Pa].
    const std::vector<dealii::SymmetricTensor<2, 2>> &
    stresses() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
