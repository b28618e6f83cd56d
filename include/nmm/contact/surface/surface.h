#ifndef nmm_contact_surface_surface_h
#define nmm_contact_surface_surface_h

#include <nmm/contact/surface/position.h>
#include <nmm/covers/cover_system.h>
#include <nmm/covers/weight_functions.h>
#include <nmm/geometry/curve.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * A body that does not deform and has no unknowns, such as a wall, a floor or the plate of
   * a press.
   */
  struct RigidObstacle
  {
    /// Name by which messages and contact laws refer to it.
    std::string name;
    /// Boundary of the obstacle, with the body on the left; each piece starts where the last one
    /// ended. It need not be closed. Full circles are not accepted: give two arcs.
    std::vector<CurvePiece> pieces;
    /// Displacement [m] as a function of time [s] (statics: the load factor); empty for an
    /// obstacle at rest.
    std::function<dealii::Tensor<1, 2>(double)> displacement;
  };


  /**
   * All faces of a solid that can touch something: edges of manifold elements on
   * boundaries, holes and both faces of open joints, and the pieces of rigid
   * obstacles. The body is on the left of an edge.
   *
   * An edge runs from t = 0 to t = 1 (arcs with constant speed). Its current position
   * is @f[ x(t) = X(t) + \sum_i w_i(X(t))\,u_i, @f] X being the straight line or the
   * arc, so that arcs stay arcs. t beyond [0, 1] continues the curve and the
   * polynomial.
   *
   * What comes in: the cover system and the obstacles, then displacements (set_displacements() or
   * set_state()) and the time (set_time()). What goes out: positions, derivatives and normals at
   * any place of an edge. Every rank holds all edges.
   *
   * Lifetime: the cover system must outlive this object.
   */
  class ContactSurface
  {
  public:
    /// Shape of the boundary where an edge meets the next one, in the reference configuration.
    enum class Corner
    {
      /// The boundary turns by less than 1e-3 rad.
      smooth,
      /// The angle inside the body is less than 180 degrees.
      convex,
      /// The angle inside the body is more than 180 degrees; tips of cracks are concave, too.
      concave,
      /// No edge follows.
      end
    };

    /// An edge in the reference configuration. The members that straight edges need most often
    /// share one cache line, and those of arcs come last, because access to edges is random.
    struct alignas(64) Edge
    {
      /// First point, see ElementEdge [m].
      dealii::Point<2> start;
      /// Last point [m].
      dealii::Point<2> end;
      /// Signed radius of an arc, 0 for straight edges, see ElementEdge [m].
      double radius = 0.;
      /// Manifold element, invalid_index for obstacles.
      unsigned int element = invalid_index;
      /// Block; for obstacle i the number of blocks + i.
      unsigned int body = invalid_index;
      /// Edge before this one along the boundary, or invalid_index.
      unsigned int previous = invalid_index;
      /// Edge after this one along the boundary, or invalid_index.
      unsigned int next = invalid_index;
      /// Corner between the previous edge and this one.
      Corner at_start = Corner::end;
      /// Corner between this edge and the next one.
      Corner at_end = Corner::end;
      /// Origin of the map xi = inverse (X - origin) to the reference coordinates of the element's
      /// cell [m].
      dealii::Point<2> origin;
      /// Inverse of the Jacobian matrix of the element's cell [1/m].
      dealii::Tensor<2, 2> inverse;
      /// Length [m].
      double length = 0.;
      /// Curve of the physical mesh, invalid_index for obstacles.
      unsigned int curve = invalid_index;
      /// Centre of an arc [m].
      dealii::Point<2> center;
      /// Polar angle of the start of an arc about its centre [rad].
      double first_angle = 0.;
      /// Polar angle of its end [rad]; less than first_angle if the arc runs clockwise.
      double last_angle = 0.;
    };

    /// A place on an edge.
    struct Place
    {
      /// Position [m].
      ContactPosition x;
      /// First derivative of the position by t [m], tangent to the edge.
      dealii::Tensor<1, 2> a;
      /// Second derivative of the position by t [m].
      dealii::Tensor<1, 2> b;

      /// Unit normal, pointing out of the body [-].
      dealii::Tensor<1, 2>
      normal() const
      {
        const double length = a.norm();
        return dealii::Point<2>(a[1] / length, -a[0] / length);
      }
    };

    /// Weight functions of the edge's element at a place, in the order of covers().
    struct WeightValues
    {
      /// Number of weight functions; 0 for obstacles.
      unsigned int n = 0;
      /// Values [-]; the first n are valid.
      double w[WeightFunctions::max_per_cell];
    };

    /// Weight functions of the edge's element at a place, with derivatives by t.
    struct Weights : public WeightValues
    {
      /// First derivatives by t [-].
      double dw[WeightFunctions::max_per_cell];
      /// Second derivatives by t [-].
      double ddw[WeightFunctions::max_per_cell];
    };

    /// Displacement along a straight edge, which is a polynomial in t.
    struct alignas(64) EdgeDisplacement
    {
      /// Coefficients of d[0] + d[1] t + d[2] t^2 [m].
      dealii::Tensor<1, 2> d[3];
    };

    /**
     * Collect all edges. In the numbering of bodies @p obstacles follow the blocks.
     * @pre The covers of all edges are relevant, see CoverSystem::make_boundary_relevant().
     * @throws InputError for an obstacle whose pieces do not follow each other,
     * have no length or are full circles.
     */
    explicit ContactSurface(const CoverSystem         &covers,
                            std::vector<RigidObstacle> obstacles = {});

    ContactSurface(const ContactSurface &) = delete;
    ContactSurface &
    operator=(const ContactSurface &) = delete;

    /// All edges: those of blocks in the order of their elements, then those of obstacles.
    const std::vector<Edge> &
    edges() const
    {
      return all_edges;
    }

    /// The obstacles of the constructor.
    const std::vector<RigidObstacle> &
    obstacles() const;

    /// The cover system of the constructor.
    const CoverSystem &
    cover_system() const;

    /// Number of blocks and obstacles.
    unsigned int
    n_bodies() const;

    /// Whether an edge belongs to an obstacle.
    bool
    is_rigid(const unsigned int edge) const
    {
      return all_edges[edge].element == invalid_index;
    }

    /// Edges of elements that this rank owns, first and past-the-end.
    std::pair<unsigned int, unsigned int>
    locally_owned_edges() const;

    /// Set which bodies are absent, one entry for each body: blocks that have left the model and
    /// obstacles that have been released. They take part neither in contact nor in pictures.
    void
    set_absent_bodies(std::vector<bool> is_absent);

    /// For each body, whether it is absent; none is unless set_absent_bodies() has been called.
    const std::vector<bool> &
    absent_bodies() const
    {
      return is_body_absent;
    }

    /// Whether the body of an edge is absent.
    bool
    is_absent(const unsigned int edge) const
    {
      return is_body_absent[all_edges[edge].body];
    }

    /// Move the obstacles to their positions at @p time [s].
    void
    set_time(double time);

    /// Move the obstacles to the mean of their positions at two times [s].
    void
    set_time(double time_begin, double time_end);

    /// Displacement of an obstacle at the time that was set [m].
    const dealii::Tensor<1, 2> &
    obstacle_displacement(unsigned int obstacle) const;

    /**
     * Check that no block overlaps an obstacle; blocks cannot overlap each other in the reference
     * configuration. A block that lies entirely behind an obstacle that is not closed counts as
     * no overlap.
     * @throws InputError if a block and an obstacle overlap by more than
     * @p tolerance [m] at the time that was set, with how much and where.
     */
    void
    check_initial_overlap(double tolerance) const;

    /**
     * Largest overlap of bodies at the current displacements and time [m]. Of all corners and
     * middles of edges of blocks that lie inside of another block or behind an obstacle, it is the
     * largest distance from the boundary of that body. All blocks are examined with
     * Boost.Geometry, independently of Contact, so that this can verify the penetrations that
     * Contact reports. Edges are approximated by two chords. Corners of obstacles inside of a
     * block and points beyond the ends of an obstacle that is not closed are not detected.
     */
    double
    largest_overlap() const;

    /// Set the displacement of each cover of the whole system [m]. Call this again whenever
    /// they change. The vector must outlive its use.
    void
    set_displacements(const std::vector<dealii::Tensor<1, 2>> *nodal);

    /// Displacements as set_displacements() stores them, for callers that need several states.
    struct State
    {
      /// Displacement of each cover of the whole system [m].
      std::vector<dealii::Tensor<1, 2>> nodal;
      /// Displacements along edges, by edge; valid for straight edges of blocks only.
      std::vector<EdgeDisplacement> edges;
    };

    /// A copy of the current displacements.
    State
    state() const;

    /// Update the displacement of an edge in @p state after its covers in state.nodal have moved.
    void
    update(State &state, unsigned int edge) const;

    /// Set the displacements of @p state, without work at each edge. The state must outlive its
    /// use.
    void
    set_state(const State &state);

    /// Reference position X(t) [m] and its derivatives.
    Place
    reference_place(unsigned int edge, double t) const;

    /// Current position x(t) [m] and its derivatives, at the current displacements and time.
    Place
    place(unsigned int edge, double t) const;

    /// Displacement x(t) - X(t) [m], without the rounding of a difference of positions.
    dealii::Tensor<1, 2>
    displacement(unsigned int edge, double t) const;

    /// Whether a point is certainly further than @p distance [m] from all places
    /// -before <= t <= 1 + after of an edge, both parameters being at most 1/2. Always false for
    /// arcs. This costs much less than the search for the nearest place.
    bool
    is_further(unsigned int           edge,
               const ContactPosition &x,
               double                 distance,
               double                 before,
               double                 after) const;

    /// Weight functions of the edge's element at the parameter @p t, and their derivatives by t.
    void
    weights(unsigned int edge, double t, Weights &weights) const;

    /// Current position [m] of the place whose @p reference position [m] and @p weights are known;
    /// cheaper than place().
    dealii::Point<2>
    position(unsigned int            edge,
             const dealii::Point<2> &reference,
             const Weights          &weights) const;

    /// Physical covers of the edge's element; none for obstacles.
    dealii::ArrayView<const unsigned int>
    covers(unsigned int edge) const;

    /// Name of the edge's curve or obstacle.
    std::string
    name(unsigned int edge) const;

  private:
    /// Distance of a point from an obstacle.
    struct Nearest
    {
      /// Distance from the nearest point of the obstacle [m].
      double distance = std::numeric_limits<double>::max();
      /// The same with a sign, negative behind the face [m].
      double gap = 0.;
      /// Whether the nearest point is an end of an obstacle that is not closed.
      bool is_open_end = false;
    };

    Nearest
    nearest_of_obstacle(unsigned int obstacle, const dealii::Point<2> &x) const;

    void
    add_elements();

    void
    add_obstacles();

    void
    find_next(unsigned int element, unsigned int position, unsigned int edge);

    void
    set_corners();

    void
    set_start_weights();

    void
    find_displacement(unsigned int                             edge,
                      const std::vector<dealii::Tensor<1, 2>> &nodal,
                      EdgeDisplacement &displacement) const;

    const CoverSystem                *cover_pointer;
    std::vector<RigidObstacle>        rigid_obstacles;
    std::vector<dealii::Tensor<1, 2>> obstacle_displacements;
    std::vector<Edge>                 all_edges;
    /// See set_absent_bodies().
    std::vector<bool> is_body_absent;
    /// First edge of each obstacle, and the number of all edges.
    std::vector<unsigned int>                obstacle_begins;
    std::pair<unsigned int, unsigned int>    owned;
    unsigned int                             degree, n_blocks;
    const std::vector<dealii::Tensor<1, 2>> *nodal = nullptr;
    /// Displacements along edges that set_displacements() computes.
    std::vector<EdgeDisplacement> edge_displacements;
    /// Displacements along edges in use: edge_displacements or those of set_state().
    const EdgeDisplacement *current = nullptr;
    /// Weight functions of straight edges at t = 0, one edge after the other: values, first
    /// derivatives by t and half of the second ones.
    std::vector<std::array<double, 3>> start_weights;
    /// First entry of start_weights of each edge, and the number of all entries.
    std::vector<unsigned int> start_weights_begin;
    /// Edge of the surface for (element, position in the element's boundary), ascending; used in
    /// the constructor only.
    std::vector<std::pair<std::pair<unsigned int, unsigned int>, unsigned int>>
      position_to_edge;
  };
} // namespace NMM

#endif
