#ifndef nmm_source_contact_detection_corner_rules_h
#define nmm_source_contact_detection_corner_rules_h

/**
 * All constants of contact at corners. Along a face none is needed: the nearest point of the other
 * face is unique, and so is its normal. Where a face ends, rules have to determine the face that
 * a point is in contact with, and the weight of the point.
 *
 * "Facing" of two faces is minus the product of their unit normals: 1 if they lie on each other,
 * 0 if they are at a right angle, -1 if they look the same way. Lengths are relative to the length
 * that the comment names. After the reason for a number, "Test:" names a test of nmm_test_contact
 * or nmm_test_dynamics that fails with the value or the omission in parentheses.
 */
namespace NMM
{
  namespace internal
  {
    namespace CornerRules
    {
      /// @name Weight of a point
      /// @{

      /**
       * Faces touch along their length up to an angle of 18 degrees, and corners touch as points
       * from 37 degrees on. In between both are blended smoothly, so that forces do not jump when a
       * block turns.
       * Test: ContactDetection.AlongUpTo18DegreesAtCornersFrom37 for where the blend begins and
       * ends; without the blend of both edges of a corner ContactPatch.InclinedJointsWithFriction.
       * @verbatim
       *    ___________            \        /
       *    ___________  along      \______/   at the corner
       *    -----------              -------------
       *    facing > 0.95            facing < 0.8
       * @endverbatim
       */
      constexpr double least_facing_along = 0.8, all_facing_along = 0.95;

      /// Faces that meet at nearly a right angle, or look the same way, do not touch at all.
      /// Test: VertexSprings.OneSpringAtAVertex (0.5).
      constexpr double least_facing = 0.01;

      /// Pieces of a face that are shorter than this fraction of a cell transmit no force, and
      /// their overlap does not count as penetration. Test: see deepest_of_piece.
      constexpr double shortest_piece = 1e-3;
      /// @}

      /// @name Where a face ends
      /// @{

      /// Two edges of a boundary that meet at less than this angle [rad] form no corner. The angle
      /// is larger than the rounding where a straight line or a circle is cut.
      constexpr double largest_smooth_angle = 1e-3;

      /**
       * Fraction of a face by which it is continued beyond its ends. On a smooth boundary this
       * closes the gap between the nearest points on two edges. At a concave corner the face is
       * continued inside the body, for points that are pressed into the corner.
       * Test: ContactPatch.InclinedJointsUnderHydrostaticPressure (0).
       * @verbatim
       *       x                       |  x
       *    ___:____  ____        _____|..:      concave: the face on the left goes on
       *        smooth                 (body below and on the right)
       * @endverbatim
       */
      constexpr double beyond_end = 0.1;

      /**
       * Fraction of a face by which it is continued at convex corners for a point at which a piece
       * of a slave begins or ends. The corner lies at that point, and neither rounding nor a small
       * motion may decide whether the point has a master.
       * Test: ContactDetection.PieceThatEndsBesideAnotherFace (0).
       * @verbatim
       *    slave   ------o-------      o: division, above the master's corner
       *    master  ______|
       * @endverbatim
       */
      constexpr double beyond_division = 0.1;

      /// A face that ends within this fraction of a piece of a slave from the division at its end has
      /// its corner there, whichever of several corners made the division. Test: none; without it the
      /// shear at the crossing of reports/tips-where-joints-cross is 0.023 MPa instead of 0.015.
      constexpr double near_division = 0.1;

      /// The same fraction where only rounding has to be compensated.
      constexpr double beyond_rounding = 1e-9;

      /// Divisions of a slave that are nearer to each other than this fraction of it are merged.
      constexpr double same_division = 1e-6;

      /// Faces meet in a corner if at most this number of edges lead from one to the other, because
      /// cutting may leave short edges in a corner.
      /// Test: ContactDetection.RandomPolygonsAgainstBruteForce (1).
      constexpr unsigned int most_edges_of_corner = 4;

      /**
       * A division belongs to the face beside the master's corner, unless that corner lies this
       * fraction of the reach behind the slave. That is more than the compression of springs, and
       * the face is then one of another body.
       * Test: ContactDetection.CornersThatPassEachOtherOnAFace (without the face beside); none for
       * the number.
       */
      constexpr double behind_division = 0.1;

      /// The master of a piece of a slave is searched for at this fraction of the piece from its
      /// end, within this many times the reach. Test: ContactBars.VertexOnVertex (0.1 times).
      constexpr double inside_of_piece = 1e-3, reach_of_piece = 2.;

      /// An edge ends at a division if it ends within this fraction of a cell of it.
      /// Test: ContactPatch.HorizontalJointsUnderPressure (0).
      constexpr double end_of_home = 0.01;
      /// @}

      /// @name Choice among several faces
      /// @{

      /// Gaps that differ by less than this fraction of the reach are equal, so that the next rule
      /// decides.
      constexpr double same_gap = 1e-9;

      /**
       * A point behind a face is not inside of the body if another face of that body is nearer that
       * looks the same way as the point's own face within 60 degrees. The point is then beyond the
       * far side of a thin body.
       * Test: ContactDetection.ThinPlates (without).
       * @verbatim
       *    ___________________  face that the point faces
       *    body
       *    ___________________  far side, nearer
       *           x ^           (the point's own normal points up)
       * @endverbatim
       */
      constexpr double far_side_facing = -0.5;

      /// Two convex bodies are separated only by pairs of a corner and a face whose reversed normal
      /// lies between those of the corner's edges (Shi 2015, entrance block). The tolerance is the
      /// sine of half a degree and includes faces that lie on each other. Test: none for the
      /// number.
      constexpr double entrance_border = 0.01;

      /// Faces of one body that look the same way within 60 degrees do not turn to face each other
      /// before candidates are searched for again. Test: ContactDetection.ThinPlates and
      /// LeavingBlocks.AreTouchedByNobodyMPI (without).
      constexpr double same_way_of_body = 0.5;

      /// A point on a piece of a slave that is deeper behind a face than this many lengths of the
      /// piece came in through the other face of a corner.
      /// Test: ContactBars.OverTheEdge (without).
      constexpr double deepest_of_piece = 4.;

      /**
       * Where corners pass each other by the side, the overlap is much narrower than deep. Such a
       * point is beside the face, and has come in through the next face round the corner. The
       * conditions are: the point is deeper behind the face than a fraction of a cell; the next
       * face begins within three depths round the corner; the overlap with the next face is shorter
       * than half of the depth.
       * Test: FacesBeside.DoNotTouch (without), Crossings.ThinPlates (0 depths),
       * ContactBars.VertexOnVertex (overlaps of any length).
       * @verbatim
       *            |  slave's body
       *    ________|_
       *            |_|____      the overlap of both corners is narrow and deep
       *    master's  |
       * @endverbatim
       */
      constexpr double least_depth_beside = 0.02, around_corner_beside = 3.,
                       longest_overlap_beside = 0.5;
      /// @}

      /*
       * Rules without a number, where they are applied, and their tests (in each case without
       * the rule):
       * - A corner is pushed out through the face by which it came in (entrance edge),
       *   NarrowPhase::project_corner(): ContactScales.TenDecadesOfWeightAndStiffness.
       * - A corner that is in front of the other face of the master's corner is outside,
       *   the same function: ContactDetection.RandomPolygonsAgainstBruteForce.
       * - The same if the face round the corner begins with edges much shorter than the distance,
       *   NarrowPhase::gap_beyond_corner(): ContactDetection.CornerOnTheFaceRoundACorner.
       * - Of two faces that meet in a convex corner the one that faces the point more is taken,
       *   NarrowPhase::project_within(): ContactPatch.InclinedJointsUnderHydrostaticPressure.
       * - A corner that touches only at one end of a step stays with the face of that end,
       *   PointProjector::stay_with_face_of_end(): ContactSteps.CornerBesideACorner.
       * - A corner beyond a concave end belongs to the face that begins there,
       *   PointProjector::face_beyond_concave_end(): ContactSteps.CornerPassesAFoot.
       */
    } // namespace CornerRules
  }   // namespace internal
} // namespace NMM

#endif
