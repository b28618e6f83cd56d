#ifndef nmm_source_contact_state_point_data_h
#define nmm_source_contact_state_point_data_h

#include <nmm/contact/state/point.h>
#include <nmm/contact/surface/surface.h>

#include <contact/detection/points.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Opening of a point by dilation [m], and the derivatives of gap minus opening by the gap and
    /// by the tangential distance from the anchor [-].
    struct Dilation
    {
      double opening = 0., by_gap = 1., by_slip = 0.;
    };


    /// Data of a contact point beside ContactPoint. Most of them do not change between two
    /// assemblies.
    struct alignas(64) PointData
    {
      /// Position of the slave in ContactSearch::slaves().
      unsigned int slave;
      /// Kind of the point, see PointKind.
      unsigned int corner = PointKind::along;
      /// Parameter on the slave. It differs from ContactPoint::s if the point is a corner of the
      /// master.
      double s = 0.;
      /// Length of the piece of the slave, between two divisions, to which the point belongs [m].
      double                       piece_length = 0.;
      ContactSurface::WeightValues weights;
      /// Law between the slave and the last master; null if there has been none.
      const ContactLaw *law = nullptr;
      /// Fraction of an edge by which masters are continued, see NarrowPhase::end_slack().
      double slack = 0.;
      /// The master that is continued by the slack; invalid_index if none is.
      unsigned int home = invalid_index;
      /// Whether ContactPoint::weight includes the angle between both faces. That is the angle when
      /// the point first has a master after detect().
      bool has_angle = false;
      /// For a time step: gaps at its beginning and end [m], shear at its beginning [Pa], work of
      /// the shear, and energy that the dashpot has dissipated [J/m].
      double gap_begin = 0., gap_end = 0., shear_begin = 0., shear_work = 0.,
             normal_loss = 0.;
      /// Gap at which the spring is at rest [m], see ContactTimeStep::begin(), and the same at the end
      /// of the step. Both differ if the master has changed to a face that is not the continuation
      /// of the first.
      double offset = 0., offset_end = 0.;
      /// Masters at the beginning and the end of the step; invalid_index if there is none.
      unsigned int master_begin = invalid_index, master_end = invalid_index;
      /// Parameter on the master at the end of the step, and the normal there.
      double               t_end = 0.;
      dealii::Tensor<1, 2> normal_end;
      /// Pressure and shear of the initial stress in the reference configuration [Pa].
      double initial_pressure = 0., initial_shear = 0.;
      /// See Multipliers::stiffening(); 1 for the penalty method [-].
      double stiffening = 1.;
      /// Slip that causes dilation or weakening: at the last accepted state, and since then [m].
      double slip = 0., new_slip = 0.;
      /// Part of ContactPoint::multiplier that is the pressure of the initial stress [Pa].
      double initial_multiplier = 0.;
      /// Whether the cohesion is that at the beginning of a time step of frozen geometry, and its
      /// value [Pa]. It acts even if the point opens.
      bool   keeps_cohesion = false;
      double kept_cohesion  = 0.;
      /// Dilation at the end of a time step.
      Dilation dilation;
      /// Range of this point in faces_beside.
      unsigned int beside_begin = 0, beside_end = 0;
    };


    /// Let a point exert nothing.
    inline void
    set_open(ContactPoint &point)
    {
      point.pressure = point.shear = 0.;
      point.state                  = ContactState::open;
    }


    /// Contact points, their data and the faces that they are beside. A range of PointData refers to
    /// these faces.
    struct PointSet
    {
      std::vector<ContactPoint> points;
      std::vector<PointData>    data;
      /// See NarrowPhase::append_faces_beside().
      std::vector<unsigned int> faces_beside;
      /// Numbers of the points that touch at the beginning or the end of a conserving step.
      std::vector<unsigned int> near_points;

      void
      clear()
      {
        points.clear();
        data.clear();
        faces_beside.clear();
      }

      /// Append other points.
      void
      append(const PointSet &other);

      /// The slaves of near_points.
      std::vector<unsigned int>
      near_slaves() const;
    };
  } // namespace internal
} // namespace NMM

#endif
