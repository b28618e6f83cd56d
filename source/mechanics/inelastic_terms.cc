#include <nmm/base/exceptions.h>
#include <nmm/mechanics/inelastic_terms.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <base/archive.h>
#include <cmath>
#include <limits>
#include <mechanics/finite_elasticity_data.h>
#include <mechanics/nodal_values.h>
#include <sstream>

namespace NMM
{
  using namespace internal;
  namespace Parallel = dealii::Utilities::MPI;

  struct InelasticTerms::Data
  {
    using Law  = std::shared_ptr<const InelasticLaw>;
    using Site = EdgeTables::Site;

    /// Response of the law at a quadrature point or on a side of a weak point, minus that of
    /// Hooke's law.
    struct Excess
    {
      dealii::SymmetricTensor<2, 2> stress;
      double                        energy;
      double                        tangent[4][4];
      bool                          has_tangent;
    };

    /// An element at which an inelastic law is evaluated: in the element itself, or on its sites of
    /// displacement conditions and ties.
    struct Element
    {
      unsigned int              element;
      bool                      is_inelastic;
      std::vector<const Site *> sites;
      /// Index of its first material state. States are those of the element's quadrature points (if
      /// it is inelastic), followed by those of the sides of its weak points.
      std::size_t first_state;
    };

    explicit Data(const FiniteElasticity::Data &elasticity);

    void
    set_laws(const std::vector<Material> &materials);

    void
    number_states();

    bool
    is_inelastic(const unsigned int region) const
    {
      return region_to_law[region] != nullptr;
    }

    /// Evaluate the law at a point with the displacement gradient @p gradient and the index
    /// @p state of its material state. Clears is_admissible if the law has no stress.
    void
    evaluate(unsigned int                region,
             const dealii::Tensor<2, 2> &gradient,
             std::size_t                 state,
             bool                        with_tangent,
             Excess                     &excess,
             InelasticLaw::Response     &response);

    void
    add_volume(const Element &item, LocalSystem &local);

    /// Add the terms of a displacement condition or tie, and advance @p state by its number of
    /// states. Returns false if nothing was added because a block is absent.
    bool
    add_weak_points(const Element &item,
                    const Site    &site,
                    std::size_t   &state,
                    LocalSystem   &local);

    const FiniteElasticity::Data *elastic;
    std::vector<Law>              region_to_law;
    std::vector<PlaneElasticity>  region_to_elasticity;
    std::vector<Element>          elements;
    std::vector<MaterialState>    accepted, current;
    /// Whether laws had a stress at all points of the last assembly.
    bool is_admissible = true;

    CoverMatrixAssembler              assembler;
    std::vector<dealii::Tensor<1, 2>> nodal;
    Matrix                            matrix, sum;
    Vector                            residual;
    Totals                            totals;
  };


  InelasticTerms::Data::Data(const FiniteElasticity::Data &elasticity)
    : elastic(&elasticity)
    , assembler(*elasticity.covers, *elasticity.constraints)
  {
    set_laws(elasticity.problem->materials);
    Assert(elasticity.is_inelastic, dealii::ExcInternalError());
    elasticity.make_tables();
    number_states();

    for (const Element &item : elements)
      for (const Site *site : item.sites)
        if (site->neighbor != invalid_index)
          assembler.couple(
            {elastic->covers_of_tie(*site).data(), 2 * elastic->n_per_cell});
    assembler.ignore_inhomogeneities();
    assembler.leave_empty_rows();
    assembler.build(matrix, residual);
  }


  void
  InelasticTerms::Data::set_laws(const std::vector<Material> &materials)
  {
    const ElasticityProblem &problem = *elastic->problem;
    region_to_law.clear();
    region_to_elasticity.clear();
    for (const unsigned int m : problem.region_to_material(
           elastic->covers->manifold_mesh().physical_mesh()))
    {
      region_to_law.push_back(materials[m].inelastic_law(problem.plane_state));
      region_to_elasticity.push_back(
        materials[m].plane_elasticity(problem.plane_state));
    }
  }


  /// States are numbered by ascending element, so that the sequence of the states of all ranks is
  /// the same for any number of ranks.
  void
  InelasticTerms::Data::number_states()
  {
    const ManifoldMesh &mesh      = elastic->covers->manifold_mesh();
    const EdgeTables   &edges     = *elastic->edges;
    auto                condition = edges.conditions.begin();
    auto                tie       = edges.ties.begin();
    const auto [first, last]      = elastic->covers->locally_owned_elements();
    for (unsigned int e = first; e < last; ++e)
    {
      Element    item{e, is_inelastic(mesh.region(e)), {}, accepted.size()};
      const auto add_sites = [&](auto &site, const auto &end) {
        for (; site != end && site->element <= e; ++site)
          if (site->element == e &&
              (item.is_inelastic ||
               (site->neighbor != invalid_index &&
                is_inelastic(mesh.region(site->neighbor)))))
            item.sites.push_back(&*site);
      };
      add_sites(condition, edges.conditions.end());
      add_sites(tie, edges.ties.end());
      std::size_t n = item.is_inelastic ? (*elastic->tables)(e).n_points : 0;
      for (const Site *site : item.sites)
        for (unsigned int q = site->first_point; q < site->last_point; ++q)
          n += edges.weak_points[q].n_sides;
      accepted.resize(accepted.size() + n);
      if (n > 0)
        elements.push_back(item);
    }
    current = accepted;
  }


  void
  InelasticTerms::Data::evaluate(const unsigned int          region,
                                 const dealii::Tensor<2, 2> &gradient,
                                 const std::size_t           state,
                                 const bool                  with_tangent,
                                 Excess                     &excess,
                                 InelasticLaw::Response     &response)
  {
    const dealii::SymmetricTensor<2, 2> strain = dealii::symmetrize(gradient);
    if (region_to_law[region]->evaluate(strain, accepted[state], response) !=
        Deformation::admissible)
    {
      is_admissible = false;
      response      = InelasticLaw::Response();
    }
    current[state] = response.state;

    const PlaneElasticity              &c     = region_to_elasticity[region];
    const dealii::SymmetricTensor<2, 2> hooke = c.stress(gradient);
    excess.stress                             = response.stress - hooke;
    excess.energy      = response.energy - 0.5 * (hooke * strain);
    excess.has_tangent = with_tangent && !response.is_elastic;
    if (!excess.has_tangent)
      return;
    hooke_moduli(c, excess.tangent);
    for (unsigned int a = 0; a < 4; ++a)
      for (unsigned int b = 0; b < 4; ++b)
        excess.tangent[a][b] = response.tangent[a][b] - excess.tangent[a][b];
  }


  void
  InelasticTerms::Data::add_volume(const Element &item, LocalSystem &local)
  {
    const CoverSystem &covers = *elastic->covers;
    const unsigned int n      = elastic->n_per_cell;
    const unsigned int region = covers.manifold_mesh().region(item.element);
    const ElementTables::View table = (*elastic->tables)(item.element);
    LocalDisplacement         u;
    u.gather(covers.covers(item.element), nodal);
    Excess                 excess;
    InelasticLaw::Response response;
    double                 forces[2 * WeightFunctions::max_per_cell] = {};
    for (unsigned int q = 0; q < table.n_points; ++q)
    {
      const double(*g)[2]      = table.gradients + q * n;
      const double      weight = table.weights[q];
      const std::size_t state  = item.first_state + q;
      evaluate(region,
               displacement_gradient(n, u.values, g),
               state,
               local.with_matrix,
               excess,
               response);
      totals.energy += weight * excess.energy;
      totals.dissipated += weight * response.dissipated;
      totals.n_yielding += !response.is_elastic;
      if (response.state.equivalent_plastic_strain > 0.)
        totals.yielded_area += weight;
      add_stress(n, g, weight * dealii::Tensor<2, 2>(excess.stress), local.rhs);
      add_stress(n, g, weight * dealii::Tensor<2, 2>(response.stress), forces);
      if (excess.has_tangent)
        add_moduli(n, g, weight, excess.tangent, local.matrix, 2 * n);
    }
    for (unsigned int i = 0; i < 2 * n; ++i)
      totals.force_scale += forces[i] * forces[i];
  }


  bool
  InelasticTerms::Data::add_weak_points(const Element &item,
                                        const Site    &site,
                                        std::size_t   &state,
                                        LocalSystem   &local)
  {
    const EdgeTables        &edges    = *elastic->edges;
    const unsigned int       n        = elastic->n_per_cell;
    const std::vector<bool> &released = elastic->amplitudes.released_conditions;
    const bool               is_absent =
      elastic->is_absent(item.element) ||
      (site.neighbor != invalid_index && elastic->is_absent(site.neighbor));
    LocalDisplacement u;
    elastic->gather(site, nodal, u);
    for (unsigned int q = site.first_point; q < site.last_point; ++q)
    {
      const WeakPoint &point = edges.weak_points[q];
      if (is_absent || (point.condition != invalid_index && !released.empty() &&
                        released[point.condition]))
      {
        state += point.n_sides;
        continue;
      }
      NitscheTerms terms(point, n, /* penalty = */ 0.);
      for (unsigned int s = 0; s < point.n_sides; ++s, ++state)
      {
        const unsigned int region = point.sides[s].region;
        if (!is_inelastic(region))
          continue;
        Excess                 excess;
        InelasticLaw::Response response;
        evaluate(region,
                 terms.gradient(u, s),
                 state,
                 local.with_matrix,
                 excess,
                 response);
        totals.n_yielding += !response.is_elastic;
        terms.fluxes[s].traction = excess.stress * point.normal;
        if (excess.has_tangent)
          terms.fluxes[s].set_traction_derivative(excess.tangent, point.normal);
      }
      if (point.condition != invalid_index)
        totals.support_work[point.condition] -=
          point.weight * (terms.force() * point.prescribed);
      terms.add(local);
    }
    return !is_absent;
  }


  InelasticTerms::InelasticTerms(const FiniteElasticity &elasticity)
    : data(std::make_unique<Data>(*elasticity.data))
  {
  }


  InelasticTerms::~InelasticTerms() = default;


  Deformation
  InelasticTerms::assemble(const Vector &u, const bool with_tangent)
  {
    Data              &d      = *data;
    const CoverSystem &covers = *d.elastic->covers;
    read_nodal_values(covers, u, d.nodal);
    d.assembler.reset(with_tangent);
    d.totals = Totals();
    d.totals.support_work.resize(d.elastic->problem->boundary_conditions.size(),
                                 0.);
    d.is_admissible      = true;
    const auto add_local = [&](dealii::ArrayView<const unsigned int> to,
                               const LocalSystem                    &local) {
      d.assembler.add(to, with_tangent ? local.matrix : nullptr, local.rhs);
    };
    LocalSystem               local;
    std::vector<unsigned int> both;
    for (const Data::Element &item : d.elements)
    {
      std::size_t state = item.first_state;
      if (item.is_inelastic)
      {
        if (!d.elastic->is_absent(item.element))
        {
          local.reset(d.elastic->n_per_cell, with_tangent);
          d.add_volume(item, local);
          add_local(covers.covers(item.element), local);
        }
        state += (*d.elastic->tables)(item.element).n_points;
      }
      for (const EdgeTables::Site *site : item.sites)
      {
        both.assign(covers.covers(item.element).begin(),
                    covers.covers(item.element).end());
        if (site->neighbor != invalid_index)
          both.insert(both.end(),
                      covers.covers(site->neighbor).begin(),
                      covers.covers(site->neighbor).end());
        local.reset(both.size(), with_tangent);
        if (d.add_weak_points(item, *site, state, local))
          add_local({both.data(), both.size()}, local);
      }
    }
    const auto sum = [&](auto &number) {
      number = Parallel::sum(number, covers.communicator());
    };
    for (double *number : {&d.totals.energy,
                           &d.totals.dissipated,
                           &d.totals.yielded_area,
                           &d.totals.force_scale})
      sum(*number);
    for (double &work : d.totals.support_work)
      sum(work);
    sum(d.totals.n_yielding);
    d.totals.force_scale = std::sqrt(d.totals.force_scale);
    d.assembler.compress(with_tangent);
    return Parallel::max(d.is_admissible ? 0 : 1, covers.communicator()) == 0
             ? Deformation::admissible
             : Deformation::inverted;
  }


  const InelasticTerms::Vector &
  InelasticTerms::residual() const
  {
    return data->residual;
  }


  const InelasticTerms::Totals &
  InelasticTerms::totals() const
  {
    return data->totals;
  }


  const InelasticTerms::Matrix &
  InelasticTerms::add_to(const Matrix &elastic_stiffness)
  {
    Data &d = *data;
    if (d.totals.n_yielding == 0)
      return elastic_stiffness;
    d.sum.copy_from(elastic_stiffness);
    d.sum.add(1., d.matrix);
    return d.sum;
  }


  void
  InelasticTerms::accept(const Vector &u)
  {
    const Deformation state = assemble(u, /* with_tangent = */ false);
    (void)state;
    Assert(state == Deformation::admissible, dealii::ExcInternalError());
    data->accepted = data->current;
  }


  void
  InelasticTerms::forget_states()
  {
    std::fill(data->accepted.begin(), data->accepted.end(), MaterialState());
    data->current = data->accepted;
  }


  void
  InelasticTerms::set_materials(const std::vector<Material> &materials)
  {
    data->set_laws(materials);
  }


  std::vector<char>
  InelasticTerms::internal_state() const
  {
    std::vector<MaterialState> all;
    for (const std::vector<MaterialState> &part :
         Parallel::all_gather(data->elastic->covers->communicator(),
                              data->accepted))
      all.insert(all.end(), part.begin(), part.end());
    return to_bytes(all);
  }


  void
  InelasticTerms::restore_internal_state(const std::vector<char> &state)
  {
    std::vector<MaterialState> all;
    from_bytes(state, all);
    for (const MaterialState &point : all)
      require_in_checkpoint(std::isfinite(point.plastic_strain.norm()) &&
                              std::isfinite(point.plastic_strain_zz) &&
                              std::isfinite(point.equivalent_plastic_strain),
                            "a plastic strain is not finite");
    Data             &d     = *data;
    const MPI_Comm    ranks = d.elastic->covers->communicator();
    const std::size_t total = Parallel::sum(d.accepted.size(), ranks);
    AssertThrow(all.size() == total,
                InputError("it has states of " + std::to_string(all.size()) +
                             " points of inelastic materials, the scene " +
                             std::to_string(total),
                           "the checkpoint",
                           "continue the scene it was written with"));
    std::size_t first = 0;
    const auto  sizes = Parallel::all_gather(ranks, d.accepted.size());
    for (unsigned int rank = 0; rank < Parallel::this_mpi_process(ranks);
         ++rank)
      first += sizes[rank];
    std::copy_n(all.begin() + first, d.accepted.size(), d.accepted.begin());
    d.current = d.accepted;
  }


  std::vector<InelasticTerms::PointValues>
  InelasticTerms::values(const unsigned int element) const
  {
    const Data &d  = *data;
    const auto  it = std::lower_bound(d.elements.begin(),
                                     d.elements.end(),
                                     element,
                                     [](const Data::Element &item,
                                        const unsigned int   wanted) {
                                       return item.element < wanted;
                                     });
    if (it == d.elements.end() || it->element != element || !it->is_inelastic)
      return {};
    const CoverSystem        &covers = *d.elastic->covers;
    const ElementTables::View table  = (*d.elastic->tables)(element);
    const unsigned int        n      = d.elastic->n_per_cell;
    const InelasticLaw       &law =
      *d.region_to_law[covers.manifold_mesh().region(element)];
    LocalDisplacement u;
    u.gather(covers.covers(element), d.nodal);
    std::vector<PointValues> result;
    InelasticLaw::Response   response;
    for (unsigned int q = 0; q < table.n_points; ++q)
    {
      const dealii::Tensor<2, 2> gradient =
        displacement_gradient(n, u.values, table.gradients + q * n);
      if (law.evaluate(dealii::symmetrize(gradient),
                       d.accepted[it->first_state + q],
                       response) != Deformation::admissible)
        response.stress[0][0] = std::numeric_limits<double>::quiet_NaN();
      result.push_back({response.stress,
                        response.stress_zz,
                        response.state.equivalent_plastic_strain});
    }
    return result;
  }
} // namespace NMM
