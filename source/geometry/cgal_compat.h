#ifndef nmm_source_geometry_cgal_compat_h
#define nmm_source_geometry_cgal_compat_h

#include <CGAL/config.h>

#if CGAL_VERSION_NR >= CGAL_VERSION_NUMBER(6, 0, 0)
#include <variant>
#else
#include <boost/variant/get.hpp>
#endif

/**
 * Differences between versions of CGAL; 5.5 is the oldest supported one.
 */
namespace NMM
{
  namespace internal
  {
    /**
     * The value of type T in a result @p variant of CGAL, or nullptr if it holds
     * another type. CGAL 6 replaced boost::variant by std::variant.
     */
    template <typename T, typename Variant>
    const T *
    get_if(const Variant &variant)
    {
#if CGAL_VERSION_NR >= CGAL_VERSION_NUMBER(6, 0, 0)
      return std::get_if<T>(&variant);
#else
      return boost::get<T>(&variant);
#endif
    }
  } // namespace internal
} // namespace NMM

#endif
