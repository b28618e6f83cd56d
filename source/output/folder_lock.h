#ifndef nmm_source_output_folder_lock_h
#define nmm_source_output_folder_lock_h

#include <filesystem>

namespace NMM
{
  namespace internal
  {
    /**
     * Keeps other runs from writing to a folder while this object exists. The lock (flock) is on
     * the folder itself, so that no file remains, and it ends with the process, however that ends.
     * File systems without such locks do not keep anyone out.
     */
    class FolderLock
    {
    public:
      /// @throws InputError if another run holds the lock of @p folder, which must exist.
      explicit FolderLock(const std::filesystem::path &folder);
      FolderLock(const FolderLock &) = delete;
      FolderLock &
      operator=(const FolderLock &) = delete;
      ~FolderLock();

    private:
      /// Descriptor of the folder; negative if it cannot be opened.
      int descriptor;
    };
  } // namespace internal
} // namespace NMM

#endif
