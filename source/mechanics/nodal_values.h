#ifndef nmm_source_mechanics_nodal_values_h
#define nmm_source_mechanics_nodal_values_h

#include <nmm/covers/cover_system.h>

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Copy the locally relevant values of @p vector into an array with two values per cover.
    /// Entries of covers that are not relevant remain unchanged.
    inline void
    read_nodal_values(const CoverSystem                           &covers,
                      const dealii::TrilinosWrappers::MPI::Vector &vector,
                      std::vector<double>                         &nodal)
    {
      nodal.resize(2 * covers.n_covers());
      if (covers.locally_owned_covers().n_elements() == covers.n_covers())
      {
        std::copy(vector.begin(), vector.end(), nodal.begin());
        return;
      }
      for (const auto cover : covers.locally_relevant_covers())
        for (unsigned int c = 0; c < 2; ++c)
          nodal[2 * covers.local_cover(cover) + c] = vector(2 * cover + c);
    }
  } // namespace internal
} // namespace NMM

#endif
