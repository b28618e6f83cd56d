#ifndef nmm_base_compat_h
#define nmm_base_compat_h

#include <deal.II/base/config.h>
#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>

/**
 * The functions of deal.II whose names or signatures depend on its version; 9.4 is the oldest
 * version that is supported. Other files call the functions here, so that only this file asks
 * for DEAL_II_VERSION_GTE().
 */
namespace NMM
{
  namespace Compat
  {
    /**
     * Empty constraints for a rank that owns @p owned and may store constraints
     * on @p relevant (a superset). deal.II 9.6 added the owned indices to the
     * constructor and deprecated the one without them.
     */
    template <typename number = double>
    dealii::AffineConstraints<number>
    make_affine_constraints(const dealii::IndexSet &owned,
                            const dealii::IndexSet &relevant)
    {
#if DEAL_II_VERSION_GTE(9, 6, 0)
      return dealii::AffineConstraints<number>(owned, relevant);
#else
      (void)owned;
      return dealii::AffineConstraints<number>(relevant);
#endif
    }

    /// MPI communicator of a Triangulation or DoFHandler, renamed in deal.II 9.7.
    template <typename MeshType>
    MPI_Comm
    communicator(const MeshType &mesh)
    {
#if DEAL_II_VERSION_GTE(9, 7, 0)
      return mesh.get_mpi_communicator();
#else
      return mesh.get_communicator();
#endif
    }
  } // namespace Compat
} // namespace NMM

#endif
