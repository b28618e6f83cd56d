#ifndef nmm_covers_unknowns_h
#define nmm_covers_unknowns_h

namespace NMM
{
  /// @name Numbering of the displacement unknowns
  /// The components 0 and 1 of the displacement of a cover are neighbours. That holds for global
  /// unknowns, for those of a rank, and for the rows and columns of the local systems of a list of
  /// covers, where the cover is a position in that list. Nothing else says how they are numbered.
  /// @{

  /// The unknown of a @p component of a @p cover.
  template <typename Index>
  constexpr Index
  unknown_of(const Index cover, const unsigned int component)
  {
    return 2 * cover + component;
  }


  /// The cover that an @p unknown belongs to.
  template <typename Index>
  constexpr Index
  cover_of(const Index unknown)
  {
    return unknown / 2;
  }


  /// The component of the displacement that an @p unknown is.
  template <typename Index>
  constexpr unsigned int
  component_of(const Index unknown)
  {
    return unknown % 2;
  }
  /// @}
} // namespace NMM

#endif
