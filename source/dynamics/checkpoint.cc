#include <nmm/dynamics/checkpoint.h>

#include <deal.II/base/mpi.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>
#include <dynamics/checkpoint_file.h>
#include <dynamics/hash.h>
#include <sstream>
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
    const SavedModel      &saved = model_interface<SavedModel>(model);
    std::ostringstream     out;
    {
      boost::archive::binary_oarchive archive(out);
      const std::uint64_t             mesh = saved.fingerprint();
      const std::uint64_t scheme      = scheme_fingerprint(integrator.scheme());
      const bool          is_closing  = state.closing.act_at(state.time);
      const auto          model_state = saved.internal_state();
      archive << mesh << scheme << is_closing << model_state;
      archive_scalars(archive, state);
      for (const Vector *vector : vectors_of(state))
      {
        const std::vector<double> values = global_values(*vector);
        archive << values;
      }
    }
    const std::string text = out.str();
    internal::CheckpointFile{kind, of_caller, {text.begin(), text.end()}}.write(
      filename, model.communicator());
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
    const MechanicalModel &model = integrator.model();
    const auto             file =
      internal::CheckpointFile::read(filename, model.communicator(), kind);
    std::istringstream in(std::string(file.state.begin(), file.state.end()));
    boost::archive::binary_iarchive archive(in);
    std::uint64_t                   mesh, scheme;
    bool                            is_closing;
    std::vector<char>               model_state;
    archive >> mesh >> scheme >> is_closing >> model_state;
    if (mesh != model_interface<SavedModel>(model).fingerprint())
      refuse_checkpoint(
        "The checkpoint is of another mesh, geometry, material or kinematics",
        filename);
    if (scheme != scheme_fingerprint(integrator.scheme()))
      refuse_checkpoint("The checkpoint is of another time integration scheme",
                        filename);
    DynamicState state = integrator.state();
    archive_scalars(archive, state);
    const unsigned int n_blocks = model_interface<BlockModel>(model).n_blocks();
    if (state.left_blocks.size() > n_blocks || state.rest.size() > n_blocks)
      refuse_checkpoint("The checkpoint is of more blocks than the " +
                          std::to_string(n_blocks) + " of the scene",
                        filename);
    state.closing.forces = is_closing ? state.u : Vector();
    for (Vector *vector : vectors_of(state))
    {
      std::vector<double> values;
      archive >> values;
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
    model_interface<SavedModel>(integrator.model())
      .restore_internal_state(model_state);
    integrator.restore(state);
  }
} // namespace NMM
