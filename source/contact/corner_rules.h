#ifndef nmm_source_contact_corner_rules_h
#define nmm_source_contact_corner_rules_h

/**
 * All numbers that decide about contact at corners. Along a face there is nothing to decide: the
 * nearest point of the other face is unique, and so is its normal. Where a face ends, something has
 * to say which face a point belongs to, and how much of the contact it stands for.
 *
 * "Facing" of two faces is minus the product of their unit normals: 1 if they lie on each other,
 * 0 if they stand at a right angle, -1 if they look the same way. Lengths are parts of what is said.
 * Each number has its reason and, after "Test:", a test of nmm_test_contact or nmm_test_dynamics
 * that fails with the value or the omission given there. "Test: none" means that both pass without
 * the rule: it may go when the scenes and bars of tests/performance show that nothing needs it.
 */
namespace NMM
{
  namespace internal
  {
    namespace CornerRules
    {
      /// @name How much a point stands for
      /// @{

      /**
       * Faces touch along their length up to 18 degrees, corners as points from 37 degrees on;
       * between both the shares are blended smoothly, so that forces do not jump when a block turns.
       * Test: none for where the blend begins and ends (0.94 and 0.81 pass); without the blend of both
       * edges of a corner ContactPatch.InclinedJointsWithFriction.
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

      /// Pieces of a face that are shorter than this part of a cell bear nothing: what they
      /// overlap by is no penetration. Test: see deepest_of_piece.
      constexpr double shortest_piece = 1e-3;
      /// @}

      /// @name Where a face ends
      /// @{

      /// Two edges of a boundary that turn by less than this angle [rad] go on smoothly, and do not
      /// meet in a corner: more than rounding makes of a straight line or a circle that is cut.
      constexpr double largest_smooth_angle = 1e-3;

      /**
       * Parts of a face by which it goes on beyond its ends. Where the boundary is smooth, a gap
       * between the feet on two edges must not be seen; into a concave corner the face goes on
       * inside the body, and has points that are pressed into the corner.
       * Test: ContactPatch.InclinedJointsUnderHydrostaticPressure (0 for smooth ends); none for
       * concave ones.
       * @verbatim
       *       x                       |  x
       *    ___:____  ____        _____|..:      concave: the face on the left goes on
       *        smooth                 (body below and on the right)
       * @endverbatim
       */
      constexpr double beyond_smooth_end = 0.1, beyond_concave_end = 0.5;

      /**
       * Part of a face by which it goes on at convex corners for a point at which a piece of
       * a slave begins or ends: that point lies where the corner lies, and neither rounding nor a
       * small motion may decide whether it has a master.
       * Test: ContactDetection.PieceThatEndsBesideAnotherFace (0).
       * @verbatim
       *    slave   ------o-------      o: division, above the master's corner
       *    master  ______|
       * @endverbatim
       */
      constexpr double beyond_division = 0.1;

      /// The same where only rounding is in the way.
      constexpr double beyond_rounding = 1e-9;

      /// Divisions of a slave that are nearer to each other than this part of it are one: the
      /// piece between weighs nothing.
      constexpr double same_division = 1e-6;

      /// Faces meet in a corner if at most this number of edges lead from one to the other: cutting
      /// may leave slivers of edges in a corner. Test: ContactDetection.RandomPolygonsAgainstBruteForce
      /// (1).
      constexpr unsigned int most_edges_of_corner = 4;

      /**
       * A division is next to a face beside the corner unless that lies this part of the reach
       * behind the slave, which is more than springs give way by: it is then another body's.
       * Test: ContactDetection.CornersThatPassEachOtherOnAFace (without the face beside); none for
       * the number.
       */
      constexpr double behind_division = 0.1;

      /// Whether a piece of a slave has a master is looked for at this part of the piece from its
      /// end, as far as this many times the reach. Test: ContactBars.VertexOnVertex (0.1 times).
      constexpr double inside_of_piece = 1e-3, reach_of_piece = 2.;

      /// The edge that ends at a division ends within this part of a cell of it. Test:
      /// ContactPatch.HorizontalJointsUnderPressure (0).
      constexpr double end_of_home = 0.01;
      /// @}

      /// @name Which of several faces
      /// @{

      /// Gaps that differ by less than this part of the reach are equal; then other rules decide.
      constexpr double same_gap = 1e-9;

      /**
       * A point is not inside of a body by a face if a face of the same body that looks the
       * point's own way, within 60 degrees, is nearer: it is then beyond the far side of a thin body.
       * Test: ContactDetection.ThinPlates (without).
       * @verbatim
       *    ___________________  face that the point faces
       *    body
       *    ___________________  far side, nearer
       *           x ^           (the point's own normal points up)
       * @endverbatim
       */
      constexpr double far_side_facing = -0.5;

      /// Only pairs of a corner and a face whose reversed normal lies between those of the corner's
      /// edges tell whether two convex bodies overlap (Shi 2015, entrance block); sine of half a
      /// degree, so that faces that lie on each other are among them. Test: none for the number.
      constexpr double entrance_border = 0.01;

      /// Faces of one body that look the same way within 60 degrees do not turn to face each other
      /// before candidates are searched for again. Test: none; it keeps candidates few.
      constexpr double same_way_of_body = 0.5;

      /// A point on a piece of a slave that is deeper behind a face than this many lengths of
      /// the piece came in by the other face of a corner. Test: ContactBars.OverTheEdge (without).
      constexpr double deepest_of_piece = 4.;

      /**
       * Corners that pass each other by the side overlap by far less than they are deep: such a
       * point is beside the face, and has come in by the next one round the corner. Faces
       * are looked at if the point is deeper than a part of a cell; the next face begins within
       * three depths round the corner, the overlap with it is shorter than half of the depth, and it
       * goes on by a part beyond its ends.
       * Test: FacesBeside.DoNotTouch (without), Crossings.ThinPlates (0 depths), ContactBars.VertexOnVertex
       * (overlaps of any length); none for the part beyond its ends.
       * @verbatim
       *            |  slave's body
       *    ________|_
       *            |_|____      the overlap of both corners is narrow and deep
       *    master's  |
       * @endverbatim
       */
      constexpr double least_depth_beside = 0.02, around_corner_beside = 3.,
                       longest_overlap_beside = 0.5, beyond_end_beside = 0.1;
      /// @}

      /*
       * Rules without a number, where they are applied, and their tests (in each case without
       * the rule):
       * - A corner is pushed out through the face by which it came in (entrance edge),
       *   ContactSearch::project_corner(): ContactScales.TenDecadesOfWeightAndStiffness.
       * - A corner that is in front of the other face of the master's corner is outside,
       *   the same function: ContactDetection.RandomPolygonsAgainstBruteForce.
       * - Of two faces that meet in a convex corner the one that faces the point more counts,
       *   ContactSearch::project_within(): ContactPatch.InclinedJointsUnderHydrostaticPressure.
       * - A corner that touches at one end of a step only stays with the face of that end,
       *   Contact::Data::stay_with_face_of_end(): ContactSteps.CornerBesideACorner.
       * - A corner beyond a concave end belongs to the face that begins there,
       *   face_beyond_concave_end(): ContactSteps.CornerPassesAFoot.
       */
    } // namespace CornerRules
  }   // namespace internal
} // namespace NMM

#endif
