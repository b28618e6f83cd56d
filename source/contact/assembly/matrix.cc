#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <contact/assembly/matrix.h>
#include <linear_algebra/matrix_sum.h>

namespace NMM
{
  namespace internal
  {
    namespace Parallel = dealii::Utilities::MPI;

    ContactMatrix::ContactMatrix(
      const ContactSurface                    &surface,
      const dealii::AffineConstraints<double> &constraints,
      const ContactSearch                     &search,
      const StickPlaces                       &stick_places,
      const ChosenBodies                      &chosen)
      : surface(&surface)
      , constraints(&constraints)
      , search(&search)
      , stick_places(&stick_places)
      , chosen(&chosen)
      , communicator(surface.cover_system().communicator())
    {
      forces.reinit(surface.cover_system().locally_owned_dofs(2), communicator);
    }


    void
    ContactMatrix::update_candidates()
    {
      are_candidates_known = false;
      if (assembler != nullptr)
        return;
      if (Parallel::n_mpi_processes(communicator) > 1)
      {
        couple_all();
        return;
      }
      // An empty pattern is sufficient for forces.
      is_coupled.assign(search->slaves().size(), false);
      make_pattern();
    }


    void
    ContactMatrix::couple_step(const std::vector<unsigned int> &slaves)
    {
      look_at_candidates();
      is_coupled.assign(is_coupled.size(), false);
      for (const unsigned int slave : slaves)
        is_coupled[slave] = true;
      has_step_pattern = true;
    }


    void
    ContactMatrix::couple(const std::vector<unsigned int> &slaves)
    {
      look_at_candidates();
      for (const unsigned int slave : slaves)
        is_coupled[slave] = true;
      if (!has_pattern || is_coupled != is_in_pattern)
        make_pattern();
    }


    void
    ContactMatrix::begin_assembly(const bool  new_with_tangent,
                                  BodyMatrix *new_body_matrix)
    {
      with_tangent = new_with_tangent;
      body_matrix  = new_body_matrix;
      assembler->reset(with_tangent && body_matrix == nullptr);
    }


    void
    ContactMatrix::add(ContactLocalSystem &local)
    {
      const unsigned int                          n = 2 * local.n_covers;
      const dealii::ArrayView<const unsigned int> covers(local.covers,
                                                         local.n_covers);
      const bool is_sparse = with_tangent && body_matrix == nullptr;
      assembler->add(covers, is_sparse ? local.matrix : nullptr, local.rhs);
      if (!with_tangent || is_sparse)
        return;
      for (unsigned int i = 0; constraints->n_constraints() > 0 && i < n; ++i)
        if (constraints->is_constrained(
              unknown_of(covers[cover_of(i)], component_of(i))))
          for (unsigned int j = 0; j < n; ++j)
            local.matrix[n * i + j] = local.matrix[n * j + i] = 0.;
      body_matrix->add(covers, local.matrix);
    }


    void
    ContactMatrix::end_assembly()
    {
      assembler->compress(with_tangent && body_matrix == nullptr);
    }


    void
    ContactMatrix::add_to_tangent(const Matrix &other)
    {
      add_rows(1., other, matrix, chosen->rows());
    }


    void
    ContactMatrix::couple_all()
    {
      look_at_candidates();
      const bool is_missing =
        !has_pattern ||
        std::find(is_coupled.begin(), is_coupled.end(), false) !=
          is_coupled.end();
      if (Parallel::max(is_missing ? 1U : 0U, communicator) == 0U)
        return;
      std::fill(is_coupled.begin(), is_coupled.end(), true);
      make_pattern();
    }


    void
    ContactMatrix::look_at_candidates()
    {
      if (are_candidates_known)
        return;
      are_candidates_known = true;
      candidates.clear();
      for (unsigned int i = 0; i < search->slaves().size(); ++i)
        append_couplings(i, candidates);
      const bool is_new = candidates != coupled_candidates;
      if (Parallel::max(is_new ? 1U : 0U, communicator) == 0U)
        return;
      coupled_candidates = candidates;
      is_coupled.assign(search->slaves().size(), false);
      has_pattern = false;
    }


    /// Append the groups of covers that may be coupled at a position, one group for each master
    /// body, with the number of its covers before it. A group has the covers of the slave, of its
    /// masters of that body, and of the anchors on that body.
    void
    ContactMatrix::append_couplings(const unsigned int         i,
                                    std::vector<unsigned int> &couplings) const
    {
      const auto        &edges   = surface->edges();
      const unsigned int slave   = search->slaves()[i];
      const auto         masters = search->masters(i);
      for (auto first = masters.begin(); first != masters.end(); ++first)
      {
        const unsigned int body     = edges[*first].body;
        const auto         is_of_it = [&](const unsigned int edge) {
          return edges[edge].body == body;
        };
        if (std::any_of(masters.begin(), first, is_of_it))
          continue;
        const unsigned int begin = couplings.size();
        couplings.push_back(0);
        const auto append = [&](const unsigned int edge) {
          const auto covers = surface->covers(edge);
          couplings.insert(couplings.end(), covers.begin(), covers.end());
        };
        const auto append_places = [&](const unsigned int key) {
          if (const auto *sticking = stick_places->find(key))
            for (const StickPlace &place : *sticking)
              if (!surface->is_rigid(place.edge))
                append(place.edge);
        };
        append(slave);
        append_places(place_key(*surface, slave, search->corner(i)));
        for (const unsigned int master : masters)
          if (is_of_it(master))
          {
            append(master);
            for (unsigned int end = 0; end < 2; ++end)
              if (search->corner(i) == PointKind::along)
                append_places(
                  place_key(*surface, master, PointKind::master_ends + end));
          }
        std::sort(couplings.begin() + begin + 1, couplings.end());
        couplings.erase(std::unique(couplings.begin() + begin + 1,
                                    couplings.end()),
                        couplings.end());
        couplings[begin] = couplings.size() - begin - 1;
      }
    }


    /// Couple elements that are tied. They are coupled in the elasticity, whose pattern must lie
    /// within that of the contact.
    void
    ContactMatrix::couple_ties()
    {
      const CoverSystem  &covers = surface->cover_system();
      const ManifoldMesh &mesh   = covers.manifold_mesh();
      const auto [first, last]   = covers.locally_owned_elements();
      const auto &curves         = mesh.physical_mesh().curves();
      const auto &piece_to_curve = mesh.physical_mesh().piece_to_curve();
      std::vector<unsigned int> both;
      for (unsigned int e = first; e < last; ++e)
        for (const ElementEdge &edge : mesh.edges(e))
        {
          if (edge.curve_set == invalid_index || edge.neighbor == invalid_index)
            continue;
          const auto &pieces = mesh.curve_set(edge.curve_set);
          if (std::all_of(pieces.begin(), pieces.end(), [&](const auto piece) {
                const Curve &curve = curves[piece_to_curve[piece]];
                return curve.role == CurveRole::joint &&
                       curve.state == JointState::open;
              }))
            continue;
          both.assign(covers.covers(e).begin(), covers.covers(e).end());
          both.insert(both.end(),
                      covers.covers(edge.neighbor).begin(),
                      covers.covers(edge.neighbor).end());
          assembler->couple({both.data(), both.size()});
        }
    }


    void
    ContactMatrix::make_pattern()
    {
      has_pattern   = true;
      is_in_pattern = is_coupled;
      assembler =
        std::make_unique<CoverMatrixAssembler>(surface->cover_system(),
                                               *constraints);
      std::vector<unsigned int> couplings;
      for (unsigned int i = 0; i < is_coupled.size(); ++i)
        if (is_coupled[i])
          append_couplings(i, couplings);
      for (unsigned int i = 0; i < couplings.size(); i += couplings[i] + 1)
        assembler->couple({couplings.data() + i + 1, couplings[i]});
      couple_ties();
      assembler->ignore_inhomogeneities();
      assembler->leave_empty_rows();
      assembler->restrict_to(chosen->covers());
      assembler->build(matrix, forces);
      ++version;
    }
  } // namespace internal
} // namespace NMM
