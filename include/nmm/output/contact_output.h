#ifndef nmm_output_contact_output_h
#define nmm_output_contact_output_h

#include <nmm/contact/contact.h>
#include <nmm/output/csv_series.h>
#include <nmm/output/picture.h>
#include <nmm/output/vtu.h>

#include <optional>
#include <string>
#include <vector>

namespace NMM
{
  /// A contact point, as it is written to files and pictures.
  struct ContactSample
  {
    /// Position on the undeformed slave [m].
    dealii::Point<2> reference;
    /// Current position [m].
    dealii::Point<2> x;
    /// Unit normal of the master, out of its body [-].
    dealii::Tensor<1, 2> normal;
    /// Index of the edge of the ContactSurface that carries the point.
    unsigned int slave = invalid_index;
    /// Index of the edge of the ContactSurface on the other side.
    unsigned int master = invalid_index;
    /// Parameter of the point on the slave edge, in [0, 1].
    double s = 0.;
    /// Distance of the faces [m]; negative for a penetration.
    double gap = 0.;
    /// Normal traction per reference length, pressure positive [Pa].
    double pressure = 0.;
    /// Shear traction per reference length [Pa]; traction() defines its sign.
    double shear = 0.;
    /// Reference length that the point represents [m]; 0 for an open point.
    double weight = 0.;
    /// Whether the point is open, sticks or slips.
    ContactState state = ContactState::open;
    /// Whether the faces are bonded at this point.
    bool is_bonded = false;

    /// Traction on the slave per reference length [Pa], pressure * n - shear * t, where t is the
    /// normal n turned by a right angle counter-clockwise.
    dealii::Tensor<1, 2>
    traction() const;
  };

  /// The name of a state in files: "open", "stick" or "slip".
  const std::string &
  to_string(ContactState state);

  /// Gathers on rank 0 the @p points of all ranks that have a weight and a master within reach.
  /// They are in the order of the surface, for any number of ranks. The result is empty on other
  /// ranks. Collective.
  std::vector<ContactSample>
  gather_contact_points(const ContactSurface            &surface,
                        const std::vector<ContactPoint> &points);

  /// Adds the obstacles to a picture, and those closed @p points whose traction is at least
  /// @p least [Pa]. The points come from gather_contact_points().
  void
  add_contact(const ContactSurface             &surface,
              const std::vector<ContactSample> &points,
              PictureData                      &data,
              double                            least = 0.);


  /**
   * Writes the contact points of a series of states: rows of the table contacts.csv, and
   * files contacts-NNNN.vtp for ParaView with their list contacts.pvd. For use on one rank.
   *
   * Lifetime: the arguments of the constructor must outlive this object.
   */
  class ContactSeries
  {
  public:
    /// @p value_name is the head of the first column, which holds the time or the load factor.
    /// @p with_table and @p with_fields say whether the table and the files for ParaView are
    /// written.
    ContactSeries(const ContactSurface  &surface,
                  const OutputDirectory &directory,
                  std::string            value_name,
                  bool                   with_table,
                  bool                   with_fields);

    /// Uses @p surface for all further states. It must outlive this object.
    void
    follow(const ContactSurface &surface);

    /// Continues an earlier run: its states up to @p last are kept, except its final state.
    /// @throws InputError if its table has other columns.
    void
    resume(double last);

    /// Writes the state at the time or load factor @p value. @p base is the name of the file
    /// without extension.
    void
    write(double                            value,
          const std::string                &base,
          const std::vector<ContactSample> &points);

    /// Writes the final state to contacts.vtp. In the table and the list it is added unless it
    /// has been written already.
    void
    finish(double value, const std::vector<ContactSample> &points);

  private:
    void
    append_rows(double value, const std::vector<ContactSample> &points);

    void
    write_points(const std::string                &name,
                 const std::vector<ContactSample> &points) const;

    std::string
    header() const;

    const ContactSurface  *surface;
    const OutputDirectory *directory;
    std::string            value_name;
    bool                   with_table, with_fields;
    FileSeries             files;
    /// The table contacts.csv, which is made with the first state.
    std::optional<CsvSeries> table;
    /// Times or load factors of the states in the table.
    std::vector<double> written;
  };
} // namespace NMM

#endif
