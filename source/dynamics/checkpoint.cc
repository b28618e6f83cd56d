#include <nmm/base/archive.h>
#include <nmm/dynamics/checkpoint.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <base/hash.h>
#include <cmath>
#include <dynamics/checkpoint_file.h>
#include <vector>

namespace NMM
{
  using internal::refuse_checkpoint;

  namespace
  {
    using Vector = DynamicState::Vector;

    const std::string kind = "a motion";

    std::uint64_t
    scheme_fingerprint(const TimeScheme &scheme)
    {
      internal::Hash hash;
      for (const double x :
           {scheme.beta, scheme.gamma, scheme.alpha_m, scheme.alpha_f})
        hash.add(x);
      hash.add(scheme.is_conserving);
      return hash.value();
    }


    /// Reads or writes all of a state but its vectors.
    template <typename Archive, typename State>
    void
    archive_scalars(Archive &archive, State &state)
    {
      archive &state.time &state.step &state.events_passed &state.next_step;
      archive                                              &state.kinetic;
      archive &state.sums.initial &state.sums.external_work;
      archive &state.sums.dissipated &state.sums.left;
      archive &state.sums.fracture &state.sums.cuts;
      archive &state.closing.begin &state.closing.end;
      archive &state.left_blocks &state.rest;
    }


    /// Checks the numbers of a state that was read, of @p n_blocks blocks.
    void
    check_scalars(const DynamicState &state, const unsigned int n_blocks)
    {
      const EnergySums &sums = state.sums;
      require_in_checkpoint(
        are_finite(std::vector<double>{state.time,
                                       state.events_passed,
                                       state.next_step,
                                       state.kinetic,
                                       sums.initial,
                                       sums.external_work,
                                       sums.dissipated,
                                       sums.left,
                                       sums.fracture,
                                       sums.cuts,
                                       state.closing.begin,
                                       state.closing.end}) &&
          state.time >= 0. && state.next_step >= 0.,
        "times and energies in it are not finite, or times negative");
      std::vector<bool> has_left(n_blocks, false);
      for (const unsigned int block : state.left_blocks)
      {
        require_in_checkpoint(block < n_blocks && !has_left[block],
                              "a block that has left is not there");
        has_left[block] = true;
      }
      require_in_checkpoint(state.rest.empty() || state.rest.size() == n_blocks,
                            "it is of another number of blocks");
      for (const auto &[since, force_x, force_y, moment] : state.rest)
        require_in_checkpoint(
          since >= 0. &&
            are_finite(std::vector<double>{force_x, force_y, moment}),
          "the rest of a block is no time, or the force on it not finite");
    }


    /// The vectors of a state, in the order of the file. Closing forces are among them while they
    /// act.
    template <typename State>
    auto
    vectors_of(State &state)
    {
      std::vector<decltype(&state.u)> vectors = {&state.u, &state.v, &state.a};
      if (state.closing.act_at(state.time))
        vectors.push_back(&state.closing.forces);
      return vectors;
    }


    /// The values of all ranks in the order of global unknowns, on rank 0.
    std::vector<double>
    global_values(const Vector &vector)
    {
      const std::vector<double> local(vector.begin(), vector.end());
      std::vector<double>       values;
      for (const auto &piece :
           dealii::Utilities::MPI::gather(vector.get_mpi_communicator(), local))
        values.insert(values.end(), piece.begin(), piece.end());
      return values;
    }
  } // namespace


  void
  Checkpoint::write(const TimeIntegrator    &integrator,
                    const std::string       &filename,
                    const std::vector<char> &of_caller)
  {
    const DynamicState    &state = integrator.state();
    const MechanicalModel &model = integrator.model();
    ByteWriter             archive;
    archive &model.fingerprint() & scheme_fingerprint(integrator.scheme()) &
      state.closing.act_at(state.time) & model.internal_state();
    archive_scalars(archive, state);
    for (const Vector *vector : vectors_of(state))
      archive &global_values(*vector);
    internal::CheckpointFile{kind, of_caller, archive.written}.write(
      filename, model.layout().communicator);
  }


  std::vector<char>
  Checkpoint::read_of_caller(const std::string &filename,
                             const MPI_Comm     communicator)
  {
    return internal::CheckpointFile::read(filename, communicator, kind)
      .preparation;
  }


  void
  Checkpoint::read(const std::string &filename, TimeIntegrator &integrator)
  {
    MechanicalModel &model = integrator.model();
    const auto       file =
      internal::CheckpointFile::read(filename,
                                     model.layout().communicator,
                                     kind);
    ByteReader                         archive(file.state);
    std::uint64_t                      mesh, scheme;
    bool                               is_closing;
    std::vector<char>                  model_state;
    archive &mesh &scheme &is_closing &model_state;
    if (mesh != model.fingerprint())
      refuse_checkpoint(
        "The checkpoint is of another mesh, geometry, material or kinematics",
        filename);
    if (scheme != scheme_fingerprint(integrator.scheme()))
      refuse_checkpoint("The checkpoint is of another time integration scheme",
                        filename);
    DynamicState state = integrator.state();
    archive_scalars(archive, state);
    check_scalars(state, model.layout().n_blocks);
    // the forces follow below
    require_in_checkpoint(!is_closing || state.time < state.closing.end,
                          "its closing forces do not fit its time");
    state.closing.forces = is_closing ? state.u : Vector();
    for (Vector *vector : vectors_of(state))
    {
      std::vector<double> values;
      archive            &values;
      require_in_checkpoint(are_finite(values),
                            "a value of an unknown is not finite");
      if (values.size() != vector->size())
        refuse_checkpoint("The checkpoint has " +
                            std::to_string(values.size()) +
                            " unknowns instead of " +
                            std::to_string(vector->size()),
                          filename);
      for (const auto i : vector->locally_owned_elements())
        (*vector)(i) = values[i];
      vector->compress(dealii::VectorOperation::insert);
    }
    require_in_checkpoint(archive.n_left() == 0, "it is longer than its state");
    model.restore_internal_state(model_state);
    try
    {
      integrator.restore(state);
    }
    catch (const NumericalFailure &failure)
    {
      require_in_checkpoint(false, failure.description());
    }
  }
} // namespace NMM
