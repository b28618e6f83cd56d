#include <nmm/analysis/further_terms.h>
#include <nmm/base/archive.h>

namespace NMM
{
  FurtherTerms::FurtherTerms(const std::vector<TermMaker> &makers,
                             const Solid                  &solid,
                             const ModelLayout            &layout)
  {
    for (const TermMaker &make : makers)
      terms.push_back(make(solid, layout));
  }


  std::vector<ForceTerm *>
  FurtherTerms::pointers() const
  {
    std::vector<ForceTerm *> result;
    for (const auto &term : terms)
      result.push_back(term.get());
    return result;
  }


  std::vector<char>
  FurtherTerms::save() const
  {
    ByteWriter archive;
    for (const auto &term : terms)
      term->save(archive);
    return std::move(archive.written);
  }


  void
  FurtherTerms::restore(const std::vector<char> &saved)
  {
    ByteReader archive(saved);
    for (const auto &term : terms)
      term->restore(archive);
  }


  void
  FurtherTerms::forget()
  {
    for (const auto &term : terms)
      term->forget();
  }
} // namespace NMM
