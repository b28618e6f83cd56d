#ifndef nmm_scene_scene_parameters_contact_h
#define nmm_scene_scene_parameters_contact_h

#include <nmm/contact/contact_integration.h>
#include <nmm/contact/contact_law.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class Entries;
  }

  enum class Analysis;
  enum class Kinematics;

  /// How faces are kept from passing through each other.
  enum class Enforcement
  {
    /// There is no contact.
    none,
    penalty,
    augmented_lagrangian
  };


  /// How two faces act on each other: entries of `Contact` and of its laws.
  struct ContactLawParameters
  {
    /// Name of the law's subsection; empty for the section `Contact` itself.
    std::string name;
    /// Names of faces, "any" for all. Laws only.
    std::array<std::string, 2> between;
    /// Name of the law in contact_laws().
    std::string law_name;
    /// What the scene gives, by key: of all laws.
    std::map<std::string, double> values;
    bool                          is_bonded = false;

    void
    list_entries(internal::Entries &entries);

    /// @throws InputError naming the parameter and its value. @p may_be_damped: do
    /// time steps know dashpots?
    void
    check(bool may_be_damped) const;

    /// Stiffnesses that the scene leaves open are those of @p springs.
    std::shared_ptr<const ContactLaw>
    make_law(const ContactLaw &springs) const;

  private:
    /// The law with the values of the scene; stiffnesses that are left open are 0.
    std::unique_ptr<ContactLaw>
    parsed_law() const;

    /// "parameter 'Contact/.../key'".
    std::string
    place(const std::string &key) const;
  };


  /// The section `Contact`.
  struct ContactSectionParameters
  {
    Enforcement enforcement = Enforcement::none;
    /// For faces that no law names.
    ContactLawParameters law;
    /// The first one that fits holds.
    std::vector<ContactLawParameters> laws;
    /// Augmented Lagrangian [m]; 0: chosen.
    double penetration_tolerance = 0.;
    /// [m]; 0: chosen.
    double reach = 0.;
    /// Above which a step fails [m]; 0: the cell size at faces.
    double             max_penetration = 0.;
    unsigned int       n_points        = 4;
    ContactIntegration integration     = ContactIntegration::length;
    /// Joints that are faces in contact, or tied, whatever the geometry says.
    std::vector<std::string> open_joints, tied_joints;

    bool
    is_present() const
    {
      return enforcement != Enforcement::none;
    }

    void
    list_entries(internal::Entries              &entries,
                 const std::vector<std::string> &law_names);

    /// @throws InputError naming the parameter that is wrong, or would not be
    /// used.
    void
    check(Analysis analysis, Kinematics kinematics, bool may_be_damped) const;
  };


  /// A rigid body: a subsection of `Obstacles`.
  struct ObstacleParameters
  {
    std::string name;
    /// Geometry file relative to the scene file, or a shape of one.
    std::string file, shape;
    /// "ux; uy", each as an amplitude [m]; empty: at rest.
    std::string displacement;
    /// It is gone from this time on [s]; negative: never.
    double release_time = -1.;

    void
    list_entries(internal::Entries &entries);
    void
    check(Analysis analysis) const;
  };
} // namespace NMM

#endif
