#ifndef nmm_tests_support_coulomb_h
#define nmm_tests_support_coulomb_h

#include <nmm/contact/contact.h>
#include <nmm/contact/law/coulomb_law.h>

namespace NMM
{
  namespace Test
  {
    /// Coulomb's law of faces that no pair names, to be read or changed: a copy of its own, so that
    /// contacts made before keep theirs.
    inline CoulombLaw &
    coulomb(ContactParameters &parameters)
    {
      const auto *old  = dynamic_cast<const CoulombLaw *>(parameters.law.get());
      const auto  copy = old == nullptr ? std::make_shared<CoulombLaw>()
                                        : std::make_shared<CoulombLaw>(*old);
      parameters.law   = copy;
      return *copy;
    }

    inline const CoulombLaw &
    coulomb(const ContactLaw &law)
    {
      return dynamic_cast<const CoulombLaw &>(law);
    }
  } // namespace Test
} // namespace NMM

#endif
