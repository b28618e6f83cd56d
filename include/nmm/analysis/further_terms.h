#ifndef nmm_analysis_further_terms_h
#define nmm_analysis_further_terms_h

#include <nmm/mechanics/force_term.h>
#include <nmm/mechanics/solid.h>

#include <functional>
#include <memory>
#include <vector>

namespace NMM
{
  /// Makes a force term beside solid and contact, such as springs between blocks, for a solid and the
  /// layout of its unknowns.
  using TermMaker =
    std::function<std::unique_ptr<ForceTerm>(const Solid       &solid,
                                             const ModelLayout &layout)>;


  /// Further force terms of a solid, and what they remember.
  class FurtherTerms
  {
  public:
    /// Call all @p makers. The arguments must outlive this object.
    FurtherTerms(const std::vector<TermMaker> &makers,
                 const Solid                  &solid,
                 const ModelLayout            &layout);

    /// The terms in the order of the makers.
    std::vector<ForceTerm *>
    pointers() const;

    /// What all terms remember, as bytes.
    std::vector<char>
    save() const;

    /// Restore what save() returned for the same makers. @throws InputError for bytes of others.
    void
    restore(const std::vector<char> &saved);

    /// Forget it.
    void
    forget();

  private:
    std::vector<std::unique_ptr<ForceTerm>> terms;
  };
} // namespace NMM

#endif
