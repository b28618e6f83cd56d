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
   * applied in small steps, each of which is *one* linear problem on the current
   * geometry x = X + u,
   * @f[ \int B^T C B\,da\;\Delta u = f(t_{n+1}) - \int B^T \sigma_n\,da. @f]
   * The stress is carried along as the initial stress of eq. (9), and the
   * stiffness (7) has no geometric part. After the step
   * @f[ \sigma_{n+1} = R\,(\sigma_n + C:\Delta\varepsilon)\,R^T, \quad
   *     x \leftarrow x + \Delta u, @f]
   * where R is the rotation in I + grad(du) (polar decomposition), because the stress of a
   * block rotates with the block.
   *
   * Geometry: gradients on x are those on X times F^-1, and areas are those on X times
   * det F, at the quadrature points of the reference configuration, which is cut
   * once. Displacement conditions and ties are Nitsche's terms on the current
   * geometry; the amount by which a step violates them is corrected in the next step.
   *
   * Errors: the points of a rotating block move on straight lines in each step, so that a block
   * rotated by theta in n steps grows by the factor (1 + theta^2/n^2)^(n/2), and the
   * error is of first order in the step. FiniteElasticity has neither error. The relation between
   * the rates of stress and strain is linear, whatever the material's
   * law; for small strains this agrees with St. Venant-Kirchhoff.
   *
   * Lifetime: all arguments of the constructor must outlive this object.
   */
  class IncrementalElasticity
  {
  public:
    /// Distributed vector of displacements [m], velocities [m/s] or forces [N/m].
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// @throws InputError as StaticElasticity.
    /// @throws NumericalFailure for a block whose supports permit a rigid motion, unless
    /// @p may_float (dynamics).
    IncrementalElasticity(const CoverSystem                       &covers,
                          const QuadratureCollection              &quadrature,
                          const dealii::AffineConstraints<double> &constraints,
                          const ElasticityProblem                 &problem,
                          bool may_float = false);
    ~IncrementalElasticity();

    /**
     * Take one step to the loads and prescribed displacements times
     * @p load_factor. Follower pressure acts on the geometry at the
     * beginning of the step. Returns the largest displacement of a cover in
     * the step [m].
     * @throws NumericalFailure if an element is turned inside out or the
     * system is singular.
     */
    double
    step(double load_factor);

    /// Result of a step that was tried.
    struct StepResult
    {
      /// Largest displacement of a cover in the step, whether it was taken or not [m].
      double largest_displacement = 0.;
      /// Whether the state is now that at the end of the step.
      bool is_taken = false;
    };

    /// Distributed sparse matrix of the unknowns.
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    /// Take one step whose linear system the caller solves. @p solve gets the stiffness [N/m^2]
    /// and r = internal forces - loads at the beginning of the step [N/m], and computes minus
    /// the displacement of the step [m] (dynamics adds inertia to both).
    double
    step(double                                         load_factor,
         const std::function<void(const Matrix &stiffness,
                                  const Vector &residual,
                                  Vector       &correction)> &solve);

    /**
     * Take one step, unless a cover would move by more than @p max_displacement [m]:
     * then nothing changes, and the caller should try a smaller step. If @p solve is empty, the
     * step is the static one.
     */
    [[nodiscard]] StepResult
    try_step(double                                         load_factor,
             double                                         max_displacement,
             const std::function<void(const Matrix &stiffness,
                                      const Vector &residual,
                                      Vector       &correction)> &solve = {});

    /// Everything that a step changes.
    struct State
    {
      /// Displacements of owned unknowns [m].
      Vector solution;
      /// @{
      /// Cauchy stresses of this rank: at the quadrature points of elements, and at those of
      /// displacement conditions and ties (two entries per point, one for each side) [Pa].
      std::vector<dealii::SymmetricTensor<2, 2>> stress, weak_stress;
      /// @}
      /// See IncrementalElasticity::work_of_loads() [J/m].
      double work_of_loads = 0.;
    };

    /// A copy of the current state.
    State
    state() const;

    /// Continue from @p state, which must be one of this object or of an equal one.
    /// @throws InputError if it is of another problem.
    void
    restore(const State &state);

    /// Strain energy of the stress on the current geometry, by the law of small strain, initial
    /// stress included [J/m].
    double
    strain_energy() const;

    /// Work done in all steps by loads that keep their direction: gravity, body force,
    /// tractions, pressures of that kind and point forces [J/m].
    double
    work_of_loads() const;

    /// Displacements, the sum of all steps, on locally relevant unknowns [m].
    const Vector &
    solution() const;

    /// Cauchy stress at the quadrature points of owned elements, one element
    /// after the other in the order of the points of the rules [Pa].
    const std::vector<dealii::SymmetricTensor<2, 2>> &
    stresses() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
