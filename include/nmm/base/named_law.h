#ifndef nmm_base_named_law_h
#define nmm_base_named_law_h

#include <memory>
#include <string>
#include <vector>

/// What laws of materials and of contact have in common: parameters that scenes give, and lists
/// of laws that scenes choose from by name.
namespace NMM
{
  /// A number of a law that scenes give.
  struct LawParameter
  {
    enum class Kind
    {
      number,
      /// Scenes give an angle in degrees, and the law has its tangent [-].
      tangent
    };

    std::string key;
    /// Within the law that was asked for its parameters.
    double     *value;
    Kind        kind;
    std::string documentation, remedy;
  };


  /// A law that scenes can choose.
  template <class Law>
  struct NamedLaw
  {
    std::string                name, documentation;
    std::shared_ptr<const Law> law;
  };


  /// @throws InputError saying that @p name, which belongs to @p where, has a bad @p value.
  void
  check_law_value(bool               is_good,
                  const std::string &name,
                  double             value,
                  const std::string &where,
                  const std::string &remedy);
} // namespace NMM

#endif
