#include <nmm/fracture/turned_tip.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <vector>

namespace NMM
{
  using dealii::Tensor;

  namespace
  {
    /// The field that leads to rotation * (X + u) instead of X + u.
    DisplacementField
    turned(const DisplacementField &u,
           const ElasticityProblem &problem,
           const Tensor<2, 2>      &rotation)
    {
      const CoverSystem        &covers = u.cover_system();
      std::vector<Tensor<1, 2>> values(covers.n_covers());
      for (unsigned int cover = 0; cover < values.size(); ++cover)
      {
        const dealii::Point<2> &x = covers.node(cover);
        values[cover] = rotation * (x + u.nodal_value(cover)) - Tensor<1, 2>(x);
      }
      return DisplacementField(covers, problem, values);
    }
  } // namespace


  Tensor<2, 2>
  rotation_at(const CrackTip &tip, const DisplacementField &u)
  {
    const dealii::Point<2> middle(1. / 3., 1. / 3.);
    const ManifoldMesh    &mesh = u.cover_system().manifold_mesh();
    const auto [first, last]    = u.cover_system().locally_owned_elements();
    Tensor<2, 2> local;
    for (unsigned int element = first; element < last; ++element)
      if (std::find(tip.regions.begin(),
                    tip.regions.end(),
                    mesh.region(element)) != tip.regions.end() &&
          mesh.reference_point(element).distance(tip.point) < tip.free_radius)
        local += mesh.area(element) * (dealii::unit_symmetric_tensor<2>() +
                                       u.gradient(element, middle));
    return dealii::project_onto_orthogonal_tensors(
      dealii::Utilities::MPI::sum(local, u.cover_system().communicator()));
  }


  IntensityFactors
  compute_turned_factors(const DisplacementField &u,
                         const ElasticityProblem &problem,
                         const CrackTip          &tip,
                         const double             largest_radius,
                         const TipLoading        &loading,
                         DiskRules               *rules)
  {
    const Tensor<2, 2> to_tip = transpose(rotation_at(tip, u));
    ElasticityProblem  seen   = problem;
    seen.gravity              = to_tip * problem.gravity;
    TipLoading seen_loading   = loading;
    for (ContactForce &force : seen_loading.contact_forces)
    {
      force.normal = to_tip * force.normal;
      force.force  = to_tip * force.force;
    }
    if (const ElementDisplacement acceleration = loading.acceleration)
      seen_loading.acceleration = [acceleration,
                                   to_tip](const unsigned int      element,
                                           const dealii::Point<2> &xi) {
        return to_tip * acceleration(element, xi);
      };
    return compute_intensity_factors(turned(u, problem, to_tip),
                                     seen,
                                     tip,
                                     largest_radius,
                                     seen_loading,
                                     rules);
  }
} // namespace NMM
