#include <nmm/base/program.h>
#include <nmm/dynamics/checkpoint.h>

#include <deal.II/base/mpi.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <dynamics/hash.h>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <libgen.h>
#include <unistd.h>
#include <vector>

namespace NMM
{
  namespace
  {
    using Vector = DynamicState::Vector;
    using Bytes  = std::vector<char>;

    constexpr char checkpoint_magic[8] =
      {'N', 'M', 'M', 'S', 'T', 'A', 'T', 'E'};
    constexpr std::uint32_t version = 10;

    std::uint64_t
    sum(const char *bytes, const std::size_t n)
    {
      internal::Hash hash;
      hash.add_bytes(bytes, n);
      return hash.value();
    }


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


    template <typename T>
    void
    put(Bytes &bytes, const T &value)
    {
      const char *begin = reinterpret_cast<const char *>(&value);
      bytes.insert(bytes.end(), begin, begin + sizeof(T));
    }


    template <typename T>
    T
    get(const char *&position)
    {
      T value;
      std::memcpy(&value, position, sizeof(T));
      position += sizeof(T);
      return value;
    }


    /// Call action(value) for each scalar of a state, in the order of the file.
    template <typename State, typename Action>
    void
    for_each_scalar(State &state, const Action &action)
    {
      action(state.time);
      action(state.step);
      action(state.events_passed);
      action(state.next_step);
      action(state.kinetic);
      action(state.sums.initial);
      action(state.sums.external_work);
      action(state.sums.dissipated);
      action(state.sums.left);
      action(state.sums.fracture);
      action(state.sums.cuts);
      action(state.closing.begin);
      action(state.closing.end);
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


    /// On rank 0, append the values of all ranks in the order of global unknowns.
    void
    append_global(const Vector &vector, Bytes &bytes)
    {
      const std::vector<double> local(vector.begin(), vector.end());
      const auto                all =
        dealii::Utilities::MPI::gather(vector.get_mpi_communicator(), local);
      for (const auto &piece : all)
        for (const double x : piece)
          put(bytes, x);
    }


    [[noreturn]] void
    refuse(const std::string &what,
           const std::string &filename,
           const std::string &remedy)
    {
      AssertThrow(false, InputError(what, filename, remedy));
      std::abort();
    }


    /// Replace the contents of a file. Returns the reason of a failure, otherwise an empty string.
    std::string
    replace_file(const std::string &filename, const Bytes &bytes)
    {
      const std::string temporary = filename + ".part";
      const int         file =
        ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      if (file < 0)
        return std::strerror(errno);
      std::size_t written = 0;
      while (written < bytes.size())
      {
        const ssize_t n =
          ::write(file, bytes.data() + written, bytes.size() - written);
        if (n < 0 && errno == EINTR)
          continue;
        if (n <= 0)
        {
          const std::string reason = std::strerror(errno);
          ::close(file);
          ::unlink(temporary.c_str());
          return reason;
        }
        written += n;
      }
      // the contents must be on the disk before the file gets its name
      bool is_whole = ::fsync(file) == 0;
      is_whole      = ::close(file) == 0 && is_whole;
      if (!is_whole || std::rename(temporary.c_str(), filename.c_str()) != 0)
      {
        const std::string reason = std::strerror(errno);
        ::unlink(temporary.c_str());
        return reason;
      }
      std::string path      = filename;
      const int   directory = ::open(::dirname(path.data()), O_RDONLY);
      if (directory >= 0)
      {
        ::fsync(directory);
        ::close(directory);
      }
      return "";
    }


    /// Reason why the file is no complete checkpoint of this version; empty if it is.
    std::string
    find_fault(const Bytes &bytes)
    {
      constexpr std::size_t head =
        sizeof(checkpoint_magic) + sizeof(version) + sizeof(std::uint64_t);
      if (bytes.empty())
        return "it is missing or empty";
      if (bytes.size() < head || std::memcmp(bytes.data(),
                                             checkpoint_magic,
                                             sizeof(checkpoint_magic)) != 0)
        return "it is no checkpoint";
      const char *position = bytes.data() + sizeof(checkpoint_magic);
      const auto  found    = get<std::uint32_t>(position);
      if (found != version)
        return "it is of version " + std::to_string(found) + ", not " +
               std::to_string(version);
      const auto length = get<std::uint64_t>(position);
      if (bytes.size() != head + length)
        return "it has " + std::to_string(bytes.size()) + " bytes instead of " +
               std::to_string(head + length);
      position = bytes.data() + bytes.size() - sizeof(std::uint64_t);
      const std::size_t n_summed = position - bytes.data();
      if (get<std::uint64_t>(position) != sum(bytes.data(), n_summed))
        return "it is damaged: its check sum is wrong";
      return "";
    }


    /// The file on all ranks, which is whole; on return, @p position is that of its first content.
    /// @throws InputError otherwise.
    Bytes
    read_file(const std::string &filename,
              const MPI_Comm     communicator,
              const char       *&position)
    {
      Bytes bytes;
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        std::ifstream in(filename, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
      }
      bytes = dealii::Utilities::MPI::broadcast(communicator, bytes);
      const std::string fault = find_fault(bytes);
      if (!fault.empty())
        refuse("The checkpoint cannot be used: " + fault,
               filename,
               "take another one, or start anew");
      position = bytes.data() + sizeof(checkpoint_magic) + sizeof(version) +
                 sizeof(std::uint64_t);
      return bytes;
    }
  } // namespace


  void
  Checkpoint::write(const TimeIntegrator &integrator,
                    const std::string    &filename,
                    const Bytes          &of_caller)
  {
    const DynamicState    &state = integrator.state();
    const MechanicalModel &model = integrator.model();
    const std::uint64_t mesh = model_interface<SavedModel>(model).fingerprint();
    Bytes               bytes;
    bytes.insert(bytes.end(),
                 std::begin(checkpoint_magic),
                 std::end(checkpoint_magic));
    put(bytes, version);
    const std::size_t length_position = bytes.size();
    put(bytes, std::uint64_t());
    put(bytes, static_cast<std::uint64_t>(of_caller.size()));
    bytes.insert(bytes.end(), of_caller.begin(), of_caller.end());
    put(bytes, mesh);
    put(bytes, scheme_fingerprint(integrator.scheme()));
    for_each_scalar(state, [&](const auto &value) { put(bytes, value); });
    put(bytes, static_cast<std::uint64_t>(state.u.size()));
    put(bytes, state.closing.act_at(state.time));
    for (const Vector *vector : vectors_of(state))
      append_global(*vector, bytes);
    put(bytes, static_cast<std::uint64_t>(state.left_blocks.size()));
    for (const unsigned int block : state.left_blocks)
      put(bytes, static_cast<std::uint64_t>(block));
    put(bytes, static_cast<std::uint64_t>(state.rest.size()));
    for (const auto &entry : state.rest)
      for (const double x : entry)
        put(bytes, x);
    const Bytes internal = model_interface<SavedModel>(model).internal_state();
    put(bytes, static_cast<std::uint64_t>(internal.size()));
    bytes.insert(bytes.end(), internal.begin(), internal.end());
    const std::uint64_t length =
      bytes.size() -
      length_position; // counts the check sum instead of the length itself
    std::memcpy(bytes.data() + length_position, &length, sizeof(length));
    put(bytes, sum(bytes.data(), bytes.size()));

    const MPI_Comm communicator = model.communicator();
    std::string    reason;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      reason = replace_file(filename, bytes);
    reason = dealii::Utilities::MPI::broadcast(communicator, reason);
    AssertThrow(reason.empty(),
                OutputFailure("The checkpoint cannot be written: " + reason,
                              filename,
                              "check folder, rights and space; the last one is "
                              "still good"));
  }


  Bytes
  Checkpoint::read_of_caller(const std::string &filename,
                             const MPI_Comm     communicator)
  {
    const char *position = nullptr;
    const Bytes bytes    = read_file(filename, communicator, position);
    const auto  n        = get<std::uint64_t>(position);
    return Bytes(position, position + n);
  }


  void
  Checkpoint::read(const std::string &filename, TimeIntegrator &integrator)
  {
    const MechanicalModel &model    = integrator.model();
    const char            *position = nullptr;
    const Bytes bytes = read_file(filename, model.communicator(), position);
    const auto  n_of_caller = get<std::uint64_t>(position);
    position += n_of_caller;
    if (get<std::uint64_t>(position) !=
        model_interface<SavedModel>(model).fingerprint())
      refuse(
        "The checkpoint is of another mesh, geometry, material or kinematics",
        filename,
        "continue with the scene it was written with");
    if (get<std::uint64_t>(position) != scheme_fingerprint(integrator.scheme()))
      refuse("The checkpoint is of another time integration scheme",
             filename,
             "continue with the scheme it was written with");

    DynamicState state = integrator.state();
    for_each_scalar(state, [&](auto &value) {
      value = get<std::decay_t<decltype(value)>>(position);
    });
    const auto n         = get<std::uint64_t>(position);
    state.closing.forces = get<bool>(position) ? state.u : Vector();
    const auto vectors   = vectors_of(state);
    if (n != state.u.size() ||
        position + (vectors.size() * n + 3) * sizeof(double) >
          bytes.data() + bytes.size())
      refuse("The checkpoint has " + std::to_string(n) +
               " unknowns instead of " + std::to_string(state.u.size()),
             filename,
             "continue with the scene it was written with");
    for (Vector *vector : vectors)
    {
      for (const auto i : vector->locally_owned_elements())
      {
        const char *entry = position + i * sizeof(double);
        (*vector)(i)      = get<double>(entry);
      }
      vector->compress(dealii::VectorOperation::insert);
      position += n * sizeof(double);
    }
    const auto n_left = get<std::uint64_t>(position);
    if (n_left > model_interface<BlockModel>(model).n_blocks())
      refuse("The checkpoint has " + std::to_string(n_left) +
               " blocks that have left, of " +
               std::to_string(model_interface<BlockModel>(model).n_blocks()),
             filename,
             "continue with the scene it was written with");
    state.left_blocks.clear();
    for (std::uint64_t i = 0; i < n_left; ++i)
      state.left_blocks.push_back(get<std::uint64_t>(position));
    const auto n_resting = get<std::uint64_t>(position);
    if (n_resting > model_interface<BlockModel>(model).n_blocks())
      refuse("The checkpoint has times of rest of " +
               std::to_string(n_resting) + " blocks, of " +
               std::to_string(model_interface<BlockModel>(model).n_blocks()),
             filename,
             "continue with the scene it was written with");
    state.rest.resize(n_resting);
    for (auto &entry : state.rest)
      for (double &x : entry)
        x = get<double>(position);
    const auto n_internal = get<std::uint64_t>(position);
    if (n_internal !=
        static_cast<std::uint64_t>(bytes.data() + bytes.size() - position) -
          sizeof(std::uint64_t))
      refuse("The checkpoint has " + std::to_string(n_internal) +
               " bytes of contact, which is not what its length says",
             filename,
             "take another one, or start anew");
    model_interface<SavedModel>(integrator.model())
      .restore_internal_state(Bytes(position, position + n_internal));
    integrator.restore(state);
  }
} // namespace NMM
