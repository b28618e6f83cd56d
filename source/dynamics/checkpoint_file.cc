#include <nmm/base/archive.h>
#include <nmm/base/program.h>

#include <base/hash.h>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <dynamics/checkpoint_file.h>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <libgen.h>
#include <unistd.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      using Bytes = std::vector<char>;

      /// What each file begins with.
      struct Head
      {
        char          magic[8] = {'N', 'M', 'M', 'S', 'T', 'A', 'T', 'E'};
        std::uint32_t version  = 15;
        /// Keeps the next member where it is on all machines.
        std::uint32_t unused = 0;
        /// Number of bytes after the head.
        std::uint64_t length = 0;
      };


      std::uint64_t
      check_sum(const char *bytes, const std::size_t n)
      {
        Hash hash;
        hash.add_bytes(bytes, n);
        return hash.value();
      }


      /// Replace the contents of a file. Returns the reason of a failure, otherwise an empty string.
      std::string
      replace_file(const std::string &filename, const Bytes &bytes)
      {
        const std::string temporary = filename + ".part";
        // If there is a link of this name, what it points to must not be overwritten.
        ::unlink(temporary.c_str());
        const int file =
          ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666);
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
        const Head expected;
        Head       head;
        if (bytes.empty())
          return "it is missing or empty, or no ordinary file";
        if (bytes.size() >= sizeof(head))
          std::memcpy(&head, bytes.data(), sizeof(head));
        if (bytes.size() < sizeof(head) ||
            !std::equal(std::begin(head.magic),
                        std::end(head.magic),
                        std::begin(expected.magic)))
          return "it is no checkpoint";
        if (head.version != expected.version)
          return "it is of version " + std::to_string(head.version) + ", not " +
                 std::to_string(expected.version);
        if (head.length != bytes.size() - sizeof(head) ||
            head.length < sizeof(std::uint64_t))
          return "it has " + std::to_string(bytes.size()) +
                 " bytes instead of " +
                 std::to_string(sizeof(head) + head.length);
        const std::size_t n_summed = bytes.size() - sizeof(std::uint64_t);
        std::uint64_t     sum;
        std::memcpy(&sum, bytes.data() + n_summed, sizeof(sum));
        if (sum != check_sum(bytes.data(), n_summed))
          return "it is damaged: its check sum is wrong";
        return "";
      }
    } // namespace


    void
    CheckpointFile::write(const std::string &filename,
                          const MPI_Comm     communicator) const
    {
      std::string reason;
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        const Bytes content = to_bytes(kind, preparation, state);
        Head        head;
        head.length = content.size() + sizeof(std::uint64_t);
        Bytes       bytes;
        const auto *begin = reinterpret_cast<const char *>(&head);
        bytes.insert(bytes.end(), begin, begin + sizeof(head));
        bytes.insert(bytes.end(), content.begin(), content.end());
        const std::uint64_t sum = check_sum(bytes.data(), bytes.size());
        begin                   = reinterpret_cast<const char *>(&sum);
        bytes.insert(bytes.end(), begin, begin + sizeof(sum));
        reason = replace_file(filename, bytes);
      }
      reason = dealii::Utilities::MPI::broadcast(communicator, reason);
      AssertThrow(reason.empty(),
                  OutputFailure("The checkpoint cannot be written: " + reason,
                                filename,
                                "check folder, rights and space; the last one "
                                "is still good"));
    }


    CheckpointFile
    CheckpointFile::read(const std::string &filename,
                         const MPI_Comm     communicator,
                         const std::string &kind)
    {
      Bytes           bytes;
      std::error_code error;
      // Of a device or a pipe there may be no end.
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0 &&
          std::filesystem::is_regular_file(filename, error))
      {
        std::ifstream in(filename, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
      }
      bytes = dealii::Utilities::MPI::broadcast(communicator, bytes);
      const std::string fault = find_fault(bytes);
      AssertThrow(fault.empty(),
                  InputError("The checkpoint cannot be used: " + fault,
                             filename,
                             "take another one, or start anew"));
      CheckpointFile file;
      from_bytes({bytes.begin() + sizeof(Head),
                  bytes.end() - sizeof(std::uint64_t)},
                 file.kind,
                 file.preparation,
                 file.state);
      if (file.kind != kind)
        refuse_checkpoint("The checkpoint is of " + file.kind +
                            ", and the scene is of " + kind,
                          filename);
      return file;
    }


    void
    refuse_checkpoint(const std::string &what, const std::string &filename)
    {
      AssertThrow(false,
                  InputError(what,
                             filename,
                             "continue with the scene it was written with"));
      std::abort();
    }

  } // namespace internal
} // namespace NMM
