#include <nmm/covers/weight_functions.h>
#include <nmm/mechanics/displacement_field.h>

#include <limits>
#include <mechanics/nodal_values.h>

namespace NMM
{
  DisplacementField::DisplacementField(
    const CoverSystem                           &covers,
    const ElasticityProblem                     &problem,
    const dealii::TrilinosWrappers::MPI::Vector &solution)
    : covers(&covers)
    , degree(covers.manifold_mesh().mathematical_mesh().degree())
    , nodal_values(covers.n_covers(), unknown_value())
  {
    internal::read_nodal_values(covers, solution, nodal_values);
    set_materials(problem);
  }


  DisplacementField::DisplacementField(
    const CoverSystem                &covers,
    const ElasticityProblem          &problem,
    std::vector<dealii::Tensor<1, 2>> nodal_values)
    : covers(&covers)
    , degree(covers.manifold_mesh().mathematical_mesh().degree())
    , nodal_values(std::move(nodal_values))
  {
    AssertDimension(this->nodal_values.size(), covers.n_covers());
    set_materials(problem);
  }


  DisplacementField
  DisplacementField::on_all_ranks() const
  {
    std::vector<dealii::Tensor<1, 2>> own;
    for (const auto cover : covers->locally_owned_covers())
      own.push_back(nodal_values[cover]);
    DisplacementField result(*this);
    result.nodal_values = internal::of_all_ranks(own, covers->communicator());
    return result;
  }


  dealii::Tensor<1, 2>
  DisplacementField::unknown_value()
  {
    dealii::Tensor<1, 2> value;
    value[0] = value[1] = std::numeric_limits<double>::quiet_NaN();
    return value;
  }


  void
  DisplacementField::set_materials(const ElasticityProblem &problem)
  {
    for (const unsigned int material :
         problem.region_to_material(covers->manifold_mesh().physical_mesh()))
    {
      const Material &m = problem.materials[material];
      region_to_elasticity.push_back(m.plane_elasticity(problem.plane_state));
      region_to_initial_stress.push_back(m.initial_stress);
    }
    if (problem.has_varying_initial_stress())
      for (const unsigned int material :
           problem.region_to_material(covers->manifold_mesh().physical_mesh()))
        region_to_varying.push_back(
          problem.materials[material].varying_initial_stress);
  }


  void
  DisplacementField::add_disk(const DiskCover              &disk,
                              const dealii::Vector<double> &coefficients)
  {
    AssertDimension(coefficients.size(), disk.n_functions());
    const auto &regions = covers->manifold_mesh().physical_mesh().regions();
    region_to_disk.resize(regions.size(), invalid_index);
    for (unsigned int r = 0; r < regions.size(); ++r)
      if (disk.contains(regions[r].inside))
        region_to_disk[r] = disks.size();
    disks.emplace_back(&disk, coefficients);
  }


  const CoverSystem &
  DisplacementField::cover_system() const
  {
    return *covers;
  }


  dealii::Tensor<1, 2>
  DisplacementField::displacement(const unsigned int      element,
                                  const dealii::Point<2> &xi) const
  {
    double values[WeightFunctions::max_per_cell];
    WeightFunctions::values(degree, xi, values);

    dealii::Tensor<1, 2> u;
    unsigned int         i = 0;
    for (const unsigned int cover : covers->covers(element))
      u += values[i++] * nodal_values[cover];
    if (!disks.empty())
      u += disk_value(element, xi).displacement;
    return u;
  }


  dealii::Tensor<2, 2>
  DisplacementField::gradient(const unsigned int      element,
                              const dealii::Point<2> &xi) const
  {
    dealii::Tensor<2, 2> sum = gradient_of_covers(element, xi);
    if (!disks.empty())
      sum += gradient_of_disks(element, xi);
    return sum;
  }


  dealii::Tensor<2, 2>
  DisplacementField::gradient_of_disks(const unsigned int      element,
                                       const dealii::Point<2> &xi) const
  {
    return disk_value(element, xi).gradient;
  }


  DiskCover::Value
  DisplacementField::disk_value(const unsigned int      element,
                                const dealii::Point<2> &xi) const
  {
    DiskCover::Value    sum;
    const ManifoldMesh &mesh = covers->manifold_mesh();
    const unsigned int  disk =
      disks.empty() ? invalid_index : region_to_disk[mesh.region(element)];
    if (disk == invalid_index)
      return sum;
    const dealii::Point<2> x =
      mesh.mathematical_mesh().reference_to_real(mesh.cell(element), xi);
    dealii::Tensor<1, 2> into_solid = mesh.reference_point(element) - x;
    // An element that holds the end of a curve is on both of its sides.
    for (const ElementEdge &edge : mesh.edges(element))
      if (edge.neighbor == element)
        into_solid = 0.;
    const auto &[cover, coefficients] = disks[disk];
    for (unsigned int i = 0; i < coefficients.size(); ++i)
    {
      const DiskCover::Value value = cover->evaluate(i, x, into_solid);
      sum.displacement += coefficients(i) * value.displacement;
      sum.gradient += coefficients(i) * value.gradient;
    }
    return sum;
  }


  dealii::Tensor<2, 2>
  DisplacementField::gradient_of_covers(const unsigned int      element,
                                        const dealii::Point<2> &xi) const
  {
    double gradients[WeightFunctions::max_per_cell][2];
    WeightFunctions::gradients(degree, xi, gradients);

    dealii::Tensor<2, 2> reference_gradient;
    unsigned int         i = 0;
    for (const unsigned int cover : covers->covers(element))
    {
      const dealii::Tensor<1, 2> &value = nodal_values[cover];
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int d = 0; d < 2; ++d)
          reference_gradient[c][d] += value[c] * gradients[i][d];
      ++i;
    }
    const ManifoldMesh &mesh = covers->manifold_mesh();
    return reference_gradient *
           dealii::invert(
             mesh.mathematical_mesh().jacobian(mesh.cell(element)));
  }


  dealii::SymmetricTensor<2, 2>
  DisplacementField::stress(const unsigned int      element,
                            const dealii::Point<2> &xi) const
  {
    return stress_from_gradient(element, xi, gradient(element, xi));
  }


  dealii::SymmetricTensor<2, 2>
  DisplacementField::stress_from_gradient(
    const unsigned int          element,
    const dealii::Point<2>     &xi,
    const dealii::Tensor<2, 2> &gradient) const
  {
    const ManifoldMesh           &mesh   = covers->manifold_mesh();
    const unsigned int            region = mesh.region(element);
    dealii::SymmetricTensor<2, 2> stress =
      region_to_initial_stress[region] +
      region_to_elasticity[region].stress(gradient);
    if (!region_to_varying.empty() && region_to_varying[region])
      stress +=
        stress_at(*region_to_varying[region],
                  mesh.mathematical_mesh().reference_to_real(mesh.cell(element),
                                                             xi));
    return stress;
  }


  dealii::Tensor<1, 2>
  DisplacementField::nodal_value(const unsigned int cover) const
  {
    AssertIndexRange(cover, nodal_values.size());
    return nodal_values[cover];
  }
} // namespace NMM
