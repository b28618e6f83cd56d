#include <nmm/base/exceptions.h>

#include <cerrno>
#include <fcntl.h>
#include <output/folder_lock.h>
#include <sys/file.h>
#include <unistd.h>

namespace NMM
{
  namespace internal
  {
    FolderLock::FolderLock(const std::filesystem::path &folder)
      : descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
    {
      if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 ||
          errno != EWOULDBLOCK)
        return;
      ::close(descriptor);
      AssertThrow(false,
                  InputError("another run writes its results to this folder",
                             "--output " + folder.string(),
                             "wait until it has ended, or name another "
                             "folder"));
    }


    FolderLock::~FolderLock()
    {
      if (descriptor >= 0)
        ::close(descriptor);
    }
  } // namespace internal
} // namespace NMM
