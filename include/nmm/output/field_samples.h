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
  /// The solution at one point. Stresses are Cauchy stresses, tension positive.
  struct FieldSample
  {
    /// Displacement u [m].
    dealii::Tensor<1, 2> displacement;
    /// Velocity [m/s]; 0 in an analysis without motion.
    dealii::Tensor<1, 2> velocity;

    /// In-plane stress and sigma_zz.
    struct Stress
    {
      /// In-plane components [Pa].
      dealii::SymmetricTensor<2, 2> in_plane;
      /// sigma_zz [Pa]; 0 in plane stress.
      double zz = 0.;
    };
    /// Stress from the gradient of the displacement; it jumps between elements.
    Stress direct;
    /// Stress from the gradient that StressRecovery has smoothed within each region.
    Stress recovered;
    /// Equivalent plastic strain [-]; 0 if no material yields.
    double plastic_strain = 0.;
  };

  /// Von Mises stress sqrt(3/2 s : s) of the three-dimensional stress deviator s [Pa].
  double
  von_mises_stress(const FieldSample::Stress &stress);

  /// In-plane principal stresses, larger one first [Pa].
  std::array<double, 2>
  principal_stresses(const FieldSample::Stress &stress);

  /**
   * Evaluates displacement, stresses, velocity and plastic strain at points of this rank's
   * elements.
   *
   * Lifetime: the arguments of the constructor must outlive this object.
   */
  class FieldEvaluator
  {
  public:
    /**
     * Gives the Cauchy stress [Pa] at the reference coordinates xi of an element's cell, for
     * the displacement gradient du_i/dX_j [-].
     */
    using StressLaw =
      std::function<FieldSample::Stress(unsigned int                element,
                                        const dealii::Point<2>     &xi,
                                        const dealii::Tensor<2, 2> &gradient)>;

    /// Gives a number at the reference coordinates xi of an element's cell.
    using ScalarField =
      std::function<double(unsigned int element, const dealii::Point<2> &xi)>;

    /// @p law gives the stress; if it is empty, stress follows from Hooke's law. @p velocity is the
    /// velocity [m/s] as a field on the covers; if it is null, samples have none.
    FieldEvaluator(const DisplacementField &field,
                   const StressRecovery    &recovery,
                   const ElasticityProblem &problem,
                   StressLaw                law      = {},
                   const DisplacementField *velocity = nullptr);

    /// Displacement and stresses at @p x [m] of @p element.
    FieldSample
    operator()(unsigned int element, const dealii::Point<2> &x) const;

    /// Whether samples have a velocity.
    bool
    has_velocity() const;

    /// Sets the equivalent plastic strain [-] of all further samples.
    void
    set_plastic_strain(ScalarField strain);

    /// Whether samples have a plastic strain.
    bool
    has_plastic_strain() const;

    /// Leaves the given blocks out of output, since they have left the scene; replaces the blocks
    /// of an earlier call.
    void
    hide_blocks(const std::vector<unsigned int> &blocks);

    /// Whether the block of @p element is part of output, see hide_blocks().
    bool
    shows(unsigned int element) const;

    /// Displacement at @p x [m] of @p element, without stresses [m].
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
    /// For each block, whether it is left out of output; empty if none is.
    std::vector<bool> is_hidden;

    double
    stress_zz(unsigned int                element,
              const dealii::Point<2>     &x,
              const dealii::Tensor<2, 2> &gradient) const;
  };


  /**
   * This rank's manifold elements as quadratic triangles, for output. Neighbouring triangles
   * share no nodes, because direct stresses jump between elements and displacements jump across
   * joints.
   */
  struct FieldTriangles
  {
    /// The six nodes of each triangle in the reference configuration [m].
    std::vector<QuadraticTriangle> nodes;
    /// The manifold element to which each triangle belongs.
    std::vector<unsigned int> elements;
    /// The solution at the six nodes of each triangle.
    std::vector<std::array<FieldSample, 6>> samples;
    /// Whether samples have a velocity.
    bool has_velocity = false;
    /// Whether samples have a plastic strain.
    bool has_plastic_strain = false;

    /// Divides all elements that @p evaluator shows and evaluates the solution at the nodes. If
    /// @p evaluator is null, there is no solution, and all samples are zero.
    FieldTriangles(const CoverSystem &covers, const FieldEvaluator *evaluator);

    /// Largest displacement on any rank [m]. Collective.
    double
    max_displacement(MPI_Comm communicator) const;

    /// A message that names a result that is not finite and its position; empty if all are
    /// finite. Collective.
    std::string
    find_not_finite(MPI_Comm communicator) const;
  };


  /// A message that names a result of @p sample that is not finite and its position @p x [m];
  /// empty if all are finite.
  std::string
  find_not_finite(const FieldSample &sample, const dealii::Point<2> &x);


  /// The numbers of a manifold element that are written to files.
  struct ElementIds
  {
    /// Index of the block.
    unsigned int block;
    /// Index of the region of the physical mesh.
    unsigned int region;
    /// Index of the material of the region; 0 if the region names none.
    unsigned int material;
  };

  /// The indices of the block, region and material of @p element.
  ElementIds
  element_ids(const ManifoldMesh &mesh, unsigned int element);

  /// Value of the @p quantity that colours a picture, at @p x [m] of an element with the indices
  /// @p ids. @p parameters choose direct or recovered stress and the centre of polar coordinates.
  double
  quantity_value(const FieldSample       &sample,
                 const ElementIds        &ids,
                 const dealii::Point<2>  &x,
                 const PictureParameters &parameters,
                 Quantity                 quantity);
} // namespace NMM

#endif
