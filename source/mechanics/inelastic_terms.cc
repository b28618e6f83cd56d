#include <nmm/base/archive.h>
#include <nmm/base/exceptions.h>
#include <nmm/mechanics/inelastic_terms.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mechanics/finite_elasticity.h>
#include <mechanics/nodal_values.h>
#include <mechanics/rotated_frame.h>
#include <sstream>

namespace NMM
{
  using namespace internal;
  namespace Parallel = dealii::Utilities::MPI;

  struct InelasticTerms::Data
  {
    using Law  = std::shared_ptr<const InelasticLaw>;
    using Site = EdgeTables::Site;

    /// Displacement gradients at a point [-]; the one at the beginning is used in conserving steps
    /// only.
    struct Gradients
    {
      dealii::Tensor<2, 2> end, begin;
    };

    /// Response of the law at a quadrature point or on a side of a weak point, minus that of the
    /// elastic law of FiniteElasticity.
    struct Excess
    {
      dealii::Tensor<2, 2> stress;
      double               energy;
      double               tangent[4][4];
      bool                 has_tangent;
      /// P, from which nothing is subtracted.
      dealii::Tensor<2, 2> whole_stress;
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

    Data(const FiniteElasticity::Data &elasticity, Kinematics kinematics);

    void
    set_laws(const std::vector<Material> &materials);

    void
    number_states();

    /// Give the material the states of an initial stress that varies.
    void
    set_initial_states();

    bool
    is_inelastic(const unsigned int region) const
    {
      return region_to_law[region] != nullptr;
    }

    /// Evaluate the law at a point whose material state has the index @p state. Clears
    /// is_admissible if the law has no stress.
    void
    evaluate(unsigned int            region,
             const Gradients        &gradients,
             std::size_t             state,
             bool                    with_tangent,
             Excess                 &excess,
             InelasticLaw::Response &response);

    /// The parts of evaluate() for both kinematics, but for admissible stresses only.
    Deformation
    evaluate_small(unsigned int            region,
                   const Gradients        &gradients,
                   std::size_t             state,
                   bool                    with_tangent,
                   Excess                 &excess,
                   InelasticLaw::Response &response) const;

    Deformation
    evaluate_rotated(unsigned int            region,
                     const Gradients        &gradients,
                     std::size_t             state,
                     bool                    with_tangent,
                     Excess                 &excess,
                     InelasticLaw::Response &response) const;

    /// Subtract the elastic law in a conserving step, or at the end of a step.
    Deformation
    subtract_elastic(unsigned int     region,
                     const Gradients &gradients,
                     Excess          &excess) const;

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
    Kinematics                    kinematics;
    bool                          is_conserving = false;
    std::vector<Law>              region_to_law;
    std::vector<PlaneElasticity>  region_to_elasticity;
    std::vector<Element>          elements;
    std::vector<MaterialState>    accepted, current;
    /// States of the undeformed material, see initial_state(); empty if no initial stress varies.
    std::vector<MaterialState> initial;
    /// Whether laws had a stress at all points of the last assembly.
    bool is_admissible = true;

    CoverMatrixAssembler              assembler;
    std::vector<dealii::Tensor<1, 2>> nodal, nodal_begin;
    Matrix                            matrix, sum;
    Vector                            residual;
    Totals                            totals;
  };


  InelasticTerms::Data::Data(const FiniteElasticity::Data &elasticity,
                             const Kinematics              kinematics)
    : elastic(&elasticity)
    , kinematics(kinematics)
    , assembler(*elasticity.covers, *elasticity.constraints)
  {
    set_laws(elasticity.problem->materials);
    Assert(elasticity.is_inelastic, dealii::ExcInternalError());
    elasticity.make_tables();
    number_states();
    if (elasticity.problem->has_varying_initial_stress())
      set_initial_states();

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


  namespace
  {
    /**
     * The state in which a material that is not strained has its initial stress sigma_0 at @p x: the
     * plastic strain is -C^-1 sigma_0, so that C (epsilon - epsilon^p) = sigma_0 at epsilon = 0. The
     * stress that is due to it does work as sigma_0 does, but the stored energy begins with
     * offset_of_energy(). In plane stress the strain across the plane begins with 0.
     */
    MaterialState
    initial_state(const Material         &material,
                  const PlaneState        plane_state,
                  const dealii::Point<2> &x)
    {
      const PlaneElasticity c       = material.plane_elasticity(plane_state);
      const auto            sigma   = material.initial_stress_at(x);
      const bool            is_thin = plane_state == PlaneState::plane_stress;
      const double          zz = material.initial_stress_zz_at(x, plane_state);
      const double          share = c.lambda * (dealii::trace(sigma) + zz) /
                           ((is_thin ? 2. : 3.) * c.lambda + 2. * c.mu);
      MaterialState result;
      result.plastic_strain =
        (share * dealii::unit_symmetric_tensor<2>() - sigma) / (2. * c.mu);
      const double nu = material.poissons_ratio;
      result.plastic_strain_zz =
        is_thin ? -nu / (1. - nu) * dealii::trace(result.plastic_strain)
                : (share - zz) / (2. * c.mu);
      return result;
    }


    /// e : C : e / 2 for the strain e of an initial_state() [Pa].
    double
    offset_of_energy(const MaterialState   &initial,
                     const PlaneElasticity &c,
                     const PlaneState       plane_state)
    {
      const double zz    = plane_state == PlaneState::plane_stress
                             ? 0.
                             : initial.plastic_strain_zz,
                   trace = dealii::trace(initial.plastic_strain) + zz;
      return 0.5 * c.lambda * trace * trace +
             c.mu * (initial.plastic_strain * initial.plastic_strain + zz * zz);
    }
  } // namespace


  void
  InelasticTerms::Data::set_initial_states()
  {
    const CoverSystem              &covers  = *elastic->covers;
    const ManifoldMesh             &mesh    = covers.manifold_mesh();
    const EdgeTables               &edges   = *elastic->edges;
    const ElasticityProblem        &problem = *elastic->problem;
    const std::vector<unsigned int> region_to_material =
      problem.region_to_material(mesh.physical_mesh());
    initial.resize(accepted.size());
    const auto set = [&](MaterialState     &state,
                         const unsigned int region,
                         const auto        &x) {
      const Material &material = problem.materials[region_to_material[region]];
      if (is_inelastic(region) && material.varying_initial_stress)
        state = initial_state(material, problem.plane_state, x);
    };
    for (const Element &item : elements)
    {
      std::size_t state = item.first_state;
      if (item.is_inelastic)
        for (const dealii::Point<2> &xi :
             elastic->quadrature->rule(item.element).get_points())
          set(initial[state++],
              mesh.region(item.element),
              mesh.mathematical_mesh().reference_to_real(
                mesh.cell(item.element), xi));
      for (const Site *site : item.sites)
        for (unsigned int q = site->first_point; q < site->last_point; ++q)
          for (unsigned int s = 0; s < edges.weak_points[q].n_sides; ++s)
            set(initial[state++],
                edges.weak_points[q].sides[s].region,
                edges.places[q]);
    }
    accepted = current = initial;
  }


  void
  InelasticTerms::Data::evaluate(const unsigned int      region,
                                 const Gradients        &gradients,
                                 const std::size_t       state,
                                 const bool              with_tangent,
                                 Excess                 &excess,
                                 InelasticLaw::Response &response)
  {
    const auto evaluate_it = kinematics == Kinematics::small
                               ? &Data::evaluate_small
                               : &Data::evaluate_rotated;
    if ((this->*evaluate_it)(
          region, gradients, state, with_tangent, excess, response) !=
        Deformation::admissible)
    {
      is_admissible = false;
      response      = InelasticLaw::Response();
      excess        = Excess();
    }
    else if (!initial.empty())
      excess.energy -= offset_of_energy(initial[state],
                                        region_to_elasticity[region],
                                        elastic->problem->plane_state);
    current[state] = response.state;
  }


  Deformation
  InelasticTerms::Data::evaluate_small(const unsigned int      region,
                                       const Gradients        &gradients,
                                       const std::size_t       state,
                                       const bool              with_tangent,
                                       Excess                 &excess,
                                       InelasticLaw::Response &response) const
  {
    const dealii::SymmetricTensor<2, 2> strain =
      dealii::symmetrize(gradients.end);
    if (region_to_law[region]->evaluate(strain, accepted[state], response) !=
        Deformation::admissible)
      return Deformation::inverted;
    const PlaneElasticity              &c     = region_to_elasticity[region];
    const dealii::SymmetricTensor<2, 2> hooke = c.stress(gradients.end);
    excess.whole_stress                       = response.stress;
    excess.stress      = dealii::Tensor<2, 2>(response.stress - hooke);
    excess.energy      = response.energy - 0.5 * (hooke * strain);
    excess.has_tangent = with_tangent && !response.is_elastic;
    if (!excess.has_tangent)
      return Deformation::admissible;
    hooke_moduli(c, excess.tangent);
    for (unsigned int a = 0; a < 4; ++a)
      for (unsigned int b = 0; b < 4; ++b)
        excess.tangent[a][b] = response.tangent[a][b] - excess.tangent[a][b];
    return Deformation::admissible;
  }


  Deformation
  InelasticTerms::Data::evaluate_rotated(const unsigned int      region,
                                         const Gradients        &gradients,
                                         const std::size_t       state,
                                         const bool              with_tangent,
                                         Excess                 &excess,
                                         InelasticLaw::Response &response) const
  {
    const InelasticLaw &law = *region_to_law[region];
    RotatedFrame        begin, end;
    if (end.reinit(gradients.end) != Deformation::admissible ||
        law.evaluate(end.strain(), accepted[state], response) !=
          Deformation::admissible)
      return Deformation::inverted;
    dealii::SymmetricTensor<2, 2> T = response.stress;
    if (is_conserving)
    {
      InelasticLaw::Response first;
      if (begin.reinit(gradients.begin) != Deformation::admissible ||
          law.evaluate(begin.strain(), accepted[state], first) !=
            Deformation::admissible)
        return Deformation::inverted;
      T = 0.5 * (T + first.stress);
    }
    const RotatedStress stress(is_conserving ? begin : end, end, T);
    excess.whole_stress = stress.first_stress();
    excess.energy       = response.energy;
    excess.has_tangent  = with_tangent;
    if (with_tangent)
    {
      double D[4][4];
      hooke_moduli(region_to_elasticity[region], D);
      stress.moduli(response.is_elastic ? D : response.tangent, excess.tangent);
    }
    return subtract_elastic(region, gradients, excess);
  }


  Deformation
  InelasticTerms::Data::subtract_elastic(const unsigned int region,
                                         const Gradients   &gradients,
                                         Excess            &excess) const
  {
    const auto subtract = [&](const auto &elastic_response) {
      excess.stress = excess.whole_stress - elastic_response.stress;
      if (excess.has_tangent)
        for (unsigned int a = 0; a < 4; ++a)
          for (unsigned int b = 0; b < 4; ++b)
            excess.tangent[a][b] -= elastic_response.tangent[a][b];
    };
    if (is_conserving)
    {
      ConservingLaw::Response response;
      const Deformation       state =
        elastic->region_to_conserving_law[region].evaluate(gradients.begin,
                                                           gradients.end,
                                                           excess.has_tangent,
                                                           /* damping = */ 0.,
                                                           response);
      subtract(response);
      return state;
    }
    HyperelasticLaw::Response response;
    const HyperelasticLaw    &law   = *elastic->region_to_law[region];
    const Deformation         state = excess.has_tangent
                                        ? law.evaluate(gradients.end, response)
                                        : law.evaluate_stress(gradients.end, response);
    excess.energy -= response.energy;
    subtract(response);
    return state;
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
    LocalDisplacement begin;
    if (is_conserving)
      begin.gather(covers.covers(item.element), nodal_begin);
    Gradients              gradients;
    Excess                 excess;
    InelasticLaw::Response response;
    double                 forces[2 * WeightFunctions::max_per_cell] = {};
    for (unsigned int q = 0; q < table.n_points; ++q)
    {
      const double(*g)[2]      = table.gradients + q * n;
      const double      weight = table.weights[q];
      const std::size_t state  = item.first_state + q;
      gradients.end            = displacement_gradient(n, u.values, g);
      if (is_conserving)
        gradients.begin = displacement_gradient(n, begin.values, g);
      evaluate(region, gradients, state, local.with_matrix, excess, response);
      totals.energy += weight * excess.energy;
      totals.dissipated += weight * response.dissipated;
      totals.n_yielding += !response.is_elastic;
      if (response.state.equivalent_plastic_strain > 0.)
        totals.yielded_area += weight;
      add_stress(n, g, weight * excess.stress, local.rhs);
      add_stress(n, g, weight * excess.whole_stress, forces);
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
    LocalDisplacement u, begin;
    elastic->gather(site, nodal, u);
    if (is_conserving)
      elastic->gather(site, nodal_begin, begin);
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
        Gradients              gradients;
        Excess                 excess;
        InelasticLaw::Response response;
        gradients.end = terms.gradient(u, s);
        if (is_conserving)
          gradients.begin = terms.gradient(begin, s);
        evaluate(region, gradients, state, local.with_matrix, excess, response);
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


  InelasticTerms::InelasticTerms(const FiniteElasticity &elasticity,
                                 const Kinematics        kinematics)
    : data(std::make_unique<Data>(*elasticity.data, kinematics))
  {
  }


  InelasticTerms::~InelasticTerms() = default;


  Deformation
  InelasticTerms::assemble(const Vector &u,
                           const bool    with_tangent,
                           const Vector *begin)
  {
    Data              &d      = *data;
    const CoverSystem &covers = *d.elastic->covers;
    read_nodal_values(covers, u, d.nodal);
    d.is_conserving = begin != nullptr;
    Assert(!d.is_conserving || d.kinematics == Kinematics::finite,
           dealii::ExcNotImplemented());
    if (d.is_conserving)
      read_nodal_values(covers, *begin, d.nodal_begin);
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
    if (d.totals.n_yielding == 0 && d.kinematics == Kinematics::small)
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
    if (data->initial.empty())
      std::fill(data->accepted.begin(), data->accepted.end(), MaterialState());
    else
      data->accepted = data->initial;
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
      const bool   is_finite = d.kinematics == Kinematics::finite;
      RotatedFrame frame;
      if ((is_finite && frame.reinit(gradient) != Deformation::admissible) ||
          law.evaluate(is_finite ? frame.strain()
                                 : dealii::symmetrize(gradient),
                       d.accepted[it->first_state + q],
                       response) != Deformation::admissible)
        response.stress[0][0] = std::numeric_limits<double>::quiet_NaN();
      else if (is_finite)
      {
        const double area = dealii::determinant(frame.F);
        response.stress =
          dealii::symmetrize(
            RotatedStress(frame, frame, response.stress).first_stress() *
            dealii::transpose(frame.F)) /
          (area * (1. + response.strain_zz));
        response.stress_zz /= area;
      }
      result.push_back({response.stress,
                        response.stress_zz,
                        response.state.equivalent_plastic_strain});
    }
    return result;
  }
} // namespace NMM
