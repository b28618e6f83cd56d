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
  /// A contact point, for files and pictures.
  struct ContactSample
  {
    /// Place on the undeformed slave and where that is now [m].
    dealii::Point<2> reference, x;
    /// Unit normal of the master, out of its body.
    dealii::Tensor<1, 2> normal;
    /// Edges of the surface, and parameter on the slave.
    unsigned int slave = invalid_index, master = invalid_index;
    double       s = 0.;
    /// [m]; positive: open.
    double gap = 0.;
    /// Per reference length [Pa].
    double pressure = 0., shear = 0.;
    /// Reference length that the point stands for [m].
    double       weight    = 0.;
    ContactState state     = ContactState::open;
    bool         is_bonded = false;

    /// Force on the slave per reference length [Pa]: p n - shear t, t being n turned
    /// by a right angle counter-clockwise.
    dealii::Tensor<1, 2>
    traction() const;
  };

  /// "open", "stick" or "slip".
  const std::string &
  to_string(ContactState state);

  /// Those of @p points, of all ranks, that have a weight and a master within reach,
  /// in the order of the surface, whatever the number of ranks; on rank 0 only.
  /// Collective.
  std::vector<ContactSample>
  gather_contact_points(const ContactSurface            &surface,
                        const std::vector<ContactPoint> &points);

  /// Force that the solid exerts on each obstacle, per unit thickness [N/m].
  /// Collective.
  std::vector<dealii::Tensor<1, 2>>
  obstacle_forces(const ContactSurface            &surface,
                  const std::vector<ContactPoint> &points);

  /// Largest pressure of all ranks' points per reference length [Pa].
  /// Collective.
  double
  largest_pressure(const ContactSurface            &surface,
                   const std::vector<ContactPoint> &points);

  /// Add obstacles and contact points, which gather_contact_points() returned, to a
  /// picture, if their traction is larger than @p least [Pa].
  void
  add_contact(const ContactSurface             &surface,
              const std::vector<ContactSample> &points,
              PictureData                      &data,
              double                            least = 0.);


  /**
   * Contact points of states of a run: contacts.csv, to which rows are added, and
   * points for ParaView, contacts-NNNN.vtp, which contacts.pvd lists. On one rank
   * only.
   *
   * Lifetime: the arguments of the constructor must outlive this object.
   */
  class ContactSeries
  {
  public:
    /// @p value_name heads the first column: time or load factor.
    ContactSeries(const ContactSurface  &surface,
                  const OutputDirectory &directory,
                  std::string            value_name,
                  bool                   with_table,
                  bool                   with_fields);

    /// States that follow are those of another surface, which must outlive this object.
    void
    follow(const ContactSurface &surface);

    /// Keep what an earlier run wrote of states up to @p last, but for its end.
    /// @throws InputError if its table has other columns.
    void
    resume(double last);

    /// The state @p value; @p base is the file's name without extension.
    void
    write(double                            value,
          const std::string                &base,
          const std::vector<ContactSample> &points);

    /// The same for the last state, called contacts.vtp; it may have been written
    /// already.
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
    /// The table contacts.csv, once there is a first state.
    std::optional<CsvSeries> table;
    /// Values of states in the table.
    std::vector<double> written;
  };
} // namespace NMM

#endif
