#ifndef step_nmm_2_incremental_elasticity_h
#define step_nmm_2_incremental_elasticity_h

#include <nmm/covers/cover_system.h>
#include <nmm/covers/weight_functions.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <vector>

namespace StepNMM2
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
   * once. Displacements are prescribed by Nitsche's method on the current geometry, see step-nmm-0;
   * the amount by which a step violates them is corrected in the next step.
   *
   * Errors: the points of a rotating block move on straight lines in each step, so that a block
   * rotated by theta in n steps grows by the factor (1 + theta^2/n^2)^(n/2), and the
   * error is of first order in the step. NMM::FiniteElasticity has neither error.
   *
   * It does what the cantilever needs: one material, whose law is that of Hooke, and on curves
   * tractions, follower pressures and displacements with both components; one rank.
   *
   * Lifetime: all arguments of the constructor must outlive this object.
   */
  class IncrementalElasticity
  {
  public:
    /// @throws NMM::InputError for a condition of another type.
    IncrementalElasticity(const NMM::CoverSystem                  &covers,
                          const NMM::QuadratureCollection         &quadrature,
                          const dealii::AffineConstraints<double> &constraints,
                          const NMM::ElasticityProblem            &problem);

    /**
     * Take one step to the loads and prescribed displacements times @p load_factor. Follower
     * pressure acts on the geometry at the beginning of the step.
     * @throws NMM::NumericalFailure if an element is turned inside out.
     */
    void
    step(double load_factor);

    /// Displacement of each cover, the sum of all steps [m].
    const std::vector<dealii::Tensor<1, 2>> &
    displacements() const;

    /// Cauchy stress at the quadrature points of all elements [Pa].
    std::vector<dealii::SymmetricTensor<2, 2>>
    stresses() const;

  private:
    static constexpr unsigned int max_per_cell =
      NMM::WeightFunctions::max_per_cell;
    /// Gradients of the weight functions of an element [1/m].
    using Gradients = std::array<dealii::Tensor<1, 2>, max_per_cell>;

    /// A quadrature point of an element, or of one of its edges with a condition.
    struct QuadraturePoint
    {
      /// Quadrature weight in the reference configuration [m^2 or m].
      double weight;
      /// Gradients by X.
      Gradients gradients;
      /// Cauchy stress at the end of the last step [Pa].
      dealii::SymmetricTensor<2, 2> stress;

      /// Null for a point of the element itself, which has nothing of what follows.
      const NMM::BoundaryCondition *condition = nullptr;
      /// The condition's value: traction or pressure (the first component) [Pa], or displacement
      /// [m].
      dealii::Tensor<1, 2> value;
      /// Weight functions [-].
      std::array<double, max_per_cell> weight_functions;
      /// Outward unit normal in the reference configuration.
      dealii::Tensor<1, 2> normal;
      /// Penalty of Nitsche's method [Pa/m].
      double penalty;
    };

    /// A quadrature point in the current configuration.
    struct CurrentPoint
    {
      /// Gradients by x.
      Gradients gradients;
      /// det F [-].
      double growth;
      /// The normal times the current length over the reference length (Nanson's formula).
      dealii::Tensor<1, 2> normal;
    };

    /// The points of an element's interior or, with a condition, of one of its edges.
    void
    add_points(unsigned int                  element,
               const NMM::EdgeRule          &rule,
               const NMM::BoundaryCondition *condition);

    CurrentPoint
    locate(unsigned int element, const QuadraturePoint &point) const;

    /// Gradient of the field with the given values of covers [-].
    dealii::Tensor<2, 2>
    gradient(unsigned int                             element,
             const std::vector<dealii::Tensor<1, 2>> &values,
             const Gradients                         &gradients) const;

    /// Add the terms of a point to the linear problem of its element.
    void
    add_terms(unsigned int           element,
              const QuadraturePoint &point,
              double                 load_factor);

    void
    add_nitsche(unsigned int           element,
                const QuadraturePoint &point,
                const CurrentPoint    &current,
                double                 load_factor);

    const NMM::CoverSystem                  *covers;
    const dealii::AffineConstraints<double> *constraints;
    const NMM::ElasticityProblem            *problem;
    unsigned int                             degree, n_per_cell;
    NMM::PlaneElasticity                     elasticity;

    std::vector<std::vector<QuadraturePoint>> element_to_points;
    std::vector<dealii::Tensor<1, 2>>         u;

    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> matrix;
    dealii::Vector<double>       rhs, solution;
    dealii::FullMatrix<double>   cell_matrix;
    dealii::Vector<double>       cell_rhs;
  };
} // namespace StepNMM2

#endif
