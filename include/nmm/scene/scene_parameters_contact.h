#ifndef nmm_scene_scene_parameters_contact_h
#define nmm_scene_scene_parameters_contact_h

#include <nmm/contact/law/law.h>
#include <nmm/contact/surface/integration.h>

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

  /// The method that keeps faces from penetrating each other.
  enum class Enforcement
  {
    /// There is no contact.
    none,
    /// Springs between faces; penetrations are proportional to pressures.
    penalty,
    /// Springs and multipliers, which are iterated until penetrations are below a tolerance.
    augmented_lagrangian
  };


  /// A contact law between two faces: entries of the section `Contact` and of its subsections.
  struct ContactLawParameters
  {
    /// Name of the law's subsection; empty for the section `Contact` itself.
    std::string name;
    /// Names of the two faces; an empty name stands for any face. The section `Contact` itself has
    /// none.
    std::array<std::string, 2> between;
    /// Name of the law in contact_laws().
    std::string law_name;
    /// Values of the parameters of all laws by their keys, in the units of scenes.
    std::map<std::string, double> values;
    /// Whether faces that touch at the start are bonded.
    bool is_bonded = false;

    /// Declares or reads the entries of the law. @throws InputError if there are not two faces.
    void
    list_entries(internal::Entries &entries);

    /// Checks all values. @throws InputError naming the parameter and its value.
    void
    check() const;

    /// Makes the law; stiffnesses that the scene leaves open are those of @p springs.
    std::shared_ptr<const ContactLaw>
    make_law(const ContactLaw &springs) const;

  private:
    /// The law with the values of the scene; stiffnesses that are left open are 0.
    std::unique_ptr<ContactLaw>
    parsed_law() const;

    /// The place of an entry in messages, "parameter 'Contact/.../key'".
    std::string
    place(const std::string &key) const;
  };


  /// The section `Contact`.
  struct ContactSectionParameters
  {
    /// The method; Enforcement::none for a scene without contact.
    Enforcement enforcement = Enforcement::none;
    /// The law between faces for which none of `laws` fits.
    ContactLawParameters law;
    /// Laws between certain faces; of several laws that fit, the first one is used.
    std::vector<ContactLawParameters> laws;
    /// Mean penetration that the augmented Lagrangian allows [m]; 0 stands for
    /// choose_contact_parameters().
    double penetration_tolerance = 0.;
    /// Distance within which faces are searched [m]; 0 stands for a tenth of the longest edge of an
    /// element.
    double reach = 0.;
    /// Length of the faces at locked corners that gives way [m]; 0 stands for
    /// choose_contact_parameters().
    double corner_rounding = 0.;
    /// Penetration above which a step fails [m]; 0 stands for the cell size at faces.
    double max_penetration = 0.;
    /// Number of Gauss-Lobatto contact points on each piece of an edge.
    unsigned int n_points = 4;
    /// Whether springs are distributed along faces or concentrated at vertices.
    ContactIntegration integration = ContactIntegration::length;
    /// Joints whose faces are in contact, even if the geometry says that they are tied.
    std::vector<std::string> open_joints;
    /// Joints that are tied, even if the geometry says that they are open.
    std::vector<std::string> tied_joints;

    /// Whether the scene has contact.
    bool
    is_present() const
    {
      return enforcement != Enforcement::none;
    }

    /// Declares or reads the entries of the section, with a subsection for each of @p law_names.
    void
    list_entries(internal::Entries              &entries,
                 const std::vector<std::string> &law_names);

    /// Checks all values. @throws InputError naming the parameter that is wrong, or that would not be
    /// used.
    void
    check() const;
  };


  /// A rigid body: a subsection of `Obstacles`.
  struct ObstacleParameters
  {
    /// Name of the subsection, by which contact laws refer to the obstacle.
    std::string name;
    /// Geometry file with the shape, relative to the scene file; empty if `shape` is given.
    std::string file;
    /// Shape as a record of a geometry file; empty if `file` is given.
    std::string shape;
    /// Displacement "ux; uy" [m], each an amplitude as in TimeDependence; empty for an obstacle at
    /// rest.
    std::string displacement;
    /// Time from which on the obstacle is removed [s]; a negative time stands for never.
    double release_time = -1.;

    /// Declares or reads the entries of the obstacle.
    void
    list_entries(internal::Entries &entries);
    /// Checks that there is one shape. @throws InputError otherwise.
    void
    check() const;
  };
} // namespace NMM

#endif
