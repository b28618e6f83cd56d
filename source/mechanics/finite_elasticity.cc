#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <mechanics/finite_elasticity.h>
#include <mechanics/nodal_values.h>

namespace NMM
{
  using namespace internal;

  FiniteElasticity::FiniteElasticity(
    const CoverSystem                       &covers,
    const QuadratureCollection              &quadrature,
    const dealii::AffineConstraints<double> &constraints,
    const ElasticityProblem                 &problem,
    const bool                               may_float,
    const GhostPenalty                      *ghost_penalty)
    : data(std::make_unique<Data>(covers,
                                  quadrature,
                                  constraints,
                                  problem,
                                  may_float,
                                  ghost_penalty))
  {
  }


  FiniteElasticity::~FiniteElasticity() = default;


  Deformation
  FiniteElasticity::assemble(const Vector &u,
                             const double  load_factor,
                             const Tangent tangent,
                             const Vector *increment)
  {
    const bool with_tangent = tangent != Tangent::none;
    read_nodal_values(*data->covers, u, data->nodal);
    if (with_tangent && increment != nullptr)
      read_nodal_values(*data->covers, *increment, data->nodal_increment);
    return data->assemble(
      {load_factor, tangent, with_tangent && increment != nullptr});
  }


  Deformation
  FiniteElasticity::assemble_between(const Vector         &begin,
                                     const Vector         &end,
                                     const Tangent         tangent,
                                     const LoadAmplitudes *first,
                                     const LoadAmplitudes *last,
                                     const double          damping)
  {
    Data &d = *data;
    d.read(begin, d.nodal_begin);
    d.read(end, d.nodal_end);
    d.nodal.resize(d.nodal_begin.size());
    d.chosen_covers.for_each(d.covers->n_covers(), [&](const unsigned int k) {
      d.nodal[k] = 0.5 * (d.nodal_begin[k] + d.nodal_end[k]);
    });
    Data::Task task{/* load_factor = */ 1., tangent};
    task.forces  = Data::Forces::between;
    task.first   = first;
    task.last    = last;
    task.damping = damping;
    return data->assemble(task);
  }


  void
  FiniteElasticity::assemble_linearized(const Vector &u,
                                        const double  load_factor)
  {
    read_nodal_values(*data->covers, u, data->nodal);
    Data::Task task{load_factor, Tangent::none};
    task.forces = Data::Forces::linearized;
    (void)data->assemble(task);
  }


  void
  FiniteElasticity::assemble_at_rest(const double load_factor)
  {
    Data &d = *data;
    d.inhomogeneities.clear();
    if (dealii::Utilities::MPI::max(d.constraints->has_inhomogeneities() ? 1
                                                                         : 0,
                                    d.covers->communicator()) == 1)
      read_nodal_values(*d.covers, initial_solution(), d.inhomogeneities);
    d.nodal.assign(d.covers->n_covers(), dealii::Tensor<1, 2>());
    Data::Task task{load_factor, Tangent::consistent};
    task.forces = Data::Forces::at_rest;
    (void)d.assemble(task);
  }


  void
  FiniteElasticity::adapt_penalties(const Vector &u)
  {
    read_nodal_values(*data->covers, u, data->nodal);
    LocalDisplacement local;
    for (const auto *sites : {&data->edges->conditions, &data->edges->ties})
      for (const EdgeTables::Site &site : *sites)
      {
        data->gather(site, data->nodal, local);
        for (unsigned int q = site.first_point; q < site.last_point; ++q)
        {
          // Penalties do not change below a growth of 2. Above, they grow with the third power,
          // because the moduli inside the element may have grown more than those on its edge.
          const double growth = growth_of_moduli(data->edges->weak_points[q],
                                                 data->region_to_law,
                                                 data->n_per_cell,
                                                 local) /
                                2.;
          data->penalty_growth[q] =
            std::max(data->penalty_growth[q], growth * growth * growth);
        }
      }
  }


  void
  FiniteElasticity::set_amplitudes(const LoadAmplitudes &amplitudes)
  {
    const auto check = [](const std::size_t  given,
                          const std::size_t  expected,
                          const std::string &what) {
      AssertThrow(given == 0 || given == expected,
                  InputError(std::to_string(given) + " amplitudes",
                             what,
                             "give none or " + std::to_string(expected)));
    };
    const ElasticityProblem &problem      = *data->problem;
    const std::size_t        n_conditions = problem.boundary_conditions.size();
    check(amplitudes.boundary_conditions.size(),
          n_conditions,
          "the boundary conditions");
    check(amplitudes.released_conditions.size(),
          n_conditions,
          "the released boundary conditions");
    check(amplitudes.point_forces.size(),
          problem.point_forces.size(),
          "the point forces");
    check(amplitudes.fixed_points.size(),
          problem.fixed_points.size(),
          "the fixed points");
    check(amplitudes.released_fixed_points.size(),
          problem.fixed_points.size(),
          "the released fixed points");
    data->amplitudes = amplitudes;
  }


  void
  FiniteElasticity::restrict_to(const BlockSelection &blocks)
  {
    data->restrict_to(blocks);
  }


  void
  FiniteElasticity::set_absent_blocks(const std::vector<bool> &is_absent)
  {
    Data               &d        = *data;
    const ManifoldMesh &mesh     = d.covers->manifold_mesh();
    const unsigned int  n_blocks = mesh.physical_mesh().n_blocks();
    AssertThrow(is_absent.empty() || is_absent.size() == n_blocks,
                InputError(std::to_string(is_absent.size()) + " entries",
                           "the absent blocks",
                           "give none or " + std::to_string(n_blocks)));
    d.absent_blocks = is_absent;
    d.absent_covers.clear();
    if (is_absent.empty())
      return;
    d.absent_covers.resize(d.covers->n_covers(), false);
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      if (is_absent[mesh.block(e)])
        for (const unsigned int k : d.covers->covers(e))
          d.absent_covers[k] = true;
  }


  std::vector<std::pair<unsigned int, unsigned int>>
  FiniteElasticity::tied_blocks() const
  {
    const ManifoldMesh &mesh = data->covers->manifold_mesh();
    std::vector<std::pair<unsigned int, unsigned int>> pairs;
    for (const EdgeTables::Site &tie : data->edges->ties)
      if (mesh.block(tie.element) != mesh.block(tie.neighbor))
        pairs.emplace_back(mesh.block(tie.element), mesh.block(tie.neighbor));
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }


  unsigned int
  FiniteElasticity::n_assembled_elements() const
  {
    return data->n_assembled;
  }


  const FiniteElasticity::Vector &
  FiniteElasticity::residual() const
  {
    return data->residual;
  }


  const dealii::TrilinosWrappers::SparseMatrix &
  FiniteElasticity::tangent() const
  {
    return data->matrix;
  }


  bool
  FiniteElasticity::tangent_is_symmetric() const
  {
    for (const BoundaryCondition &c : data->problem->boundary_conditions)
      if (c.type == BoundaryCondition::Type::follower_pressure &&
          c.value != nullptr)
        return false;
    return true;
  }


  const FiniteElasticity::Energies &
  FiniteElasticity::energies() const
  {
    return data->energies;
  }


  double
  FiniteElasticity::force_scale() const
  {
    return data->force_scale;
  }


  double
  FiniteElasticity::largest_jump() const
  {
    return data->largest_jump;
  }


  FiniteElasticity::Vector
  FiniteElasticity::initial_solution() const
  {
    Vector distributed(data->covers->locally_owned_dofs(2),
                       data->covers->communicator());
    data->constraints->distribute(distributed);
    Vector result(data->covers->locally_owned_dofs(2),
                  data->covers->locally_relevant_dofs(2),
                  data->covers->communicator());
    result = distributed;
    return result;
  }


  const CoverSystem &
  FiniteElasticity::cover_system() const
  {
    return *data->covers;
  }


  const ElasticityProblem &
  FiniteElasticity::elasticity_problem() const
  {
    return *data->problem;
  }


  const dealii::AffineConstraints<double> &
  FiniteElasticity::affine_constraints() const
  {
    return *data->constraints;
  }


  const HyperelasticLaw &
  FiniteElasticity::law(const unsigned int region) const
  {
    return *data->region_to_law[region];
  }


  bool
  FiniteElasticity::is_inelastic() const
  {
    return data->is_inelastic;
  }

} // namespace NMM
