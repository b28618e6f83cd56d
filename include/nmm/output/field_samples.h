#ifndef nmm_output_field_samples_h
#define nmm_output_field_samples_h

#include <nmm/covers/triangulate.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/stress_recovery.h>
#include <nmm/output/picture_parameters.h>

#include <array>
#include <functional>
#include <vector>

namespace NMM
{
  /// The solution at one point; stresses tension positive [Pa].
  struct FieldSample
  {
    dealii::Tensor<1, 2> displacement;
    /// 0 where nothing moves [m/s].
    dealii::Tensor<1, 2> velocity;

    /// In-plane stress and sigma_zz.
    struct Stress
    {
      dealii::SymmetricTensor<2, 2> in_plane;
      double                        zz = 0.;
    };
    Stress direct, recovered;
    /// Equivalent plastic strain; 0 where nothing yields [-].
    double plastic_strain = 0.;
  };

  /// sqrt(3/2 s : s) of the three-dimensional deviator s [Pa].
  double
  von_mises_stress(const FieldSample::Stress &stress);

  /// In-plane principal stresses, larger one first [Pa].
  std::array<double, 2>
  principal_stresses(const FieldSample::Stress &stress);

  /**
   * Evaluates displacement and stresses at points of this rank's elements.
   * Lifetime: the arguments of the constructor must outlive it.
   */
  class FieldEvaluator
  {
  public:
    /**
     * Cauchy stress [Pa] at reference coordinates xi of an element's cell where
     * the displacement gradient du_i/dX_j [-] is given.
     */
    using StressLaw =
      std::function<FieldSample::Stress(unsigned int                element,
                                        const dealii::Point<2>     &xi,
                                        const dealii::Tensor<2, 2> &gradient)>;

    /// A number at reference coordinates xi of an element's cell.
    using ScalarField =
      std::function<double(unsigned int element, const dealii::Point<2> &xi)>;

    /// With @p law instead of the linear one, if it is given, and with the
    /// velocities of the covers [m/s] as a field @p velocity, if it is given.
    FieldEvaluator(const DisplacementField &field,
                   const StressRecovery    &recovery,
                   const ElasticityProblem &problem,
                   StressLaw                law      = {},
                   const DisplacementField *velocity = nullptr);

    /// Displacement and stresses at @p x [m] of @p element.
    FieldSample
    operator()(unsigned int element, const dealii::Point<2> &x) const;

    bool
    has_velocity() const;

    /// From now on samples have the plastic strain @p strain.
    void
    set_plastic_strain(ScalarField strain);

    bool
    has_plastic_strain() const;

    /// Blocks that have left are in no output.
    void
    hide_blocks(const std::vector<unsigned int> &blocks);

    bool
    shows(unsigned int element) const;

    /// Displacement alone [m].
    dealii::Tensor<1, 2>
    displacement(unsigned int element, const dealii::Point<2> &x) const;

  private:
    const DisplacementField  *field;
    const StressRecovery     *recovery;
    const ElasticityProblem  *problem;
    std::vector<unsigned int> region_to_material;
    StressLaw                 law;
    const DisplacementField  *velocity;
    ScalarField               plastic_strain;
    /// For each block, whether it is left out; empty: none is.
    std::vector<bool> is_hidden;

    double
    stress_zz(unsigned int element, const dealii::Tensor<2, 2> &gradient) const;
  };


  /**
   * This rank's manifold elements as quadratic triangles, for output. Nodes of
   * neighbouring triangles are not shared, because direct stresses jump between
   * elements and displacements jump across joints.
   */
  struct FieldTriangles
  {
    std::vector<QuadraticTriangle>          nodes;
    std::vector<unsigned int>               elements;
    std::vector<std::array<FieldSample, 6>> samples;
    bool                                    has_velocity       = false;
    bool                                    has_plastic_strain = false;

    /// Without a solution (@p evaluator null) all samples are zero.
    FieldTriangles(const CoverSystem &covers, const FieldEvaluator *evaluator);

    /// Largest displacement on any rank [m].
    double
    max_displacement(MPI_Comm communicator) const;

    /// Which result is not finite, and where; empty: all are. Collective.
    std::string
    find_not_finite(MPI_Comm communicator) const;
  };


  /// Which result at @p x is not finite, and where; empty: all are.
  std::string
  find_not_finite(const FieldSample &sample, const dealii::Point<2> &x);


  /// Indices of a manifold element's block, region and material (0 if the
  /// region has none).
  struct ElementIds
  {
    unsigned int block, region, material;
  };

  ElementIds
  element_ids(const ManifoldMesh &mesh, unsigned int element);

  /// The number a picture is coloured by, at @p x [m] of an element.
  double
  quantity_value(const FieldSample       &sample,
                 const ElementIds        &ids,
                 const dealii::Point<2>  &x,
                 const PictureParameters &parameters,
                 Quantity                 quantity);
} // namespace NMM

#endif
