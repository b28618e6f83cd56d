#ifndef nmm_base_named_law_h
#define nmm_base_named_law_h

#include <memory>
#include <string>
#include <vector>

/// What laws of materials, of contact and of crack growth have in common: parameters that scenes
/// give, and lists of laws from which scenes choose by name.
namespace NMM
{
  /// A parameter of a law, with what is needed to read it from a scene. Numbers in scenes are finite
  /// and at least 0. Laws of one list may share a key with the same kind and default; the help text
  /// of scenes is then that of the first of these laws.
  struct LawParameter
  {
    /// How the number in a scene becomes the value in the law.
    enum class Kind
    {
      /// The law takes the number as it is.
      number,
      /// The scene gives an angle [degrees], and the law takes its tangent [-].
      tangent
    };

    /// Name of the entry in a scene, e.g. "Friction angle".
    std::string key;
    /// Points into the law that was asked for its parameters, and must not outlive it.
    double *value;
    /// Whether the value is the number in the scene or its tangent.
    Kind kind;
    /// Help text of the entry, with its unit.
    std::string documentation;
    /// Advice in the message if a scene gives a number that is negative, not finite, or an
    /// angle of 90 degrees or more.
    std::string remedy;
  };


  /// A law that scenes can choose by name.
  template <class Law>
  struct NamedLaw
  {
    /// The word in scenes that chooses this law.
    std::string name;
    /// Part of the help text that says what the law does.
    std::string documentation;
    /// The law with default parameters; never null.
    std::shared_ptr<const Law> law;
  };


  /// Does nothing if @p is_good. @throws InputError otherwise, with the message
  /// "<name> is <value>, at <where>: <remedy>".
  void
  check_law_value(bool               is_good,
                  const std::string &name,
                  double             value,
                  const std::string &where,
                  const std::string &remedy);
} // namespace NMM

#endif
