#ifndef nmm_contact_contact_surface_h
#define nmm_contact_contact_surface_h

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
   * A body that does not deform and has no unknowns: walls, floors, the plates of
   * a press.
   */
  struct RigidObstacle
  {
    /// For messages and laws of contact.
    std::string name;
    /// Its boundary, the body on the left; each piece starts where the last one
    /// ended. It need not be closed. Full circles are no pieces: give arcs.
    std::vector<CurvePiece> pieces;
    /// Displacement [m] at a time (or load factor); empty: at rest.
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
   * Every rank holds all edges.
   *
   * Lifetime: the cover system must outlive this object.
   */
  class ContactSurface
  {
  public:
    /// What the boundary does where an edge meets the next one.
    enum class Corner
    {
      smooth,
      convex,
      concave,
      /// No edge follows.
      end
    };

    /// What straight edges are asked for most lies in one line of the cache, and what arcs
    /// need comes last: edges are met all over the memory.
    struct alignas(64) Edge
    {
      /// See ElementEdge [m].
      dealii::Point<2> start, end;
      double           radius = 0.;
      /// Manifold element, invalid_index for obstacles.
      unsigned int element = invalid_index;
      /// Block; for obstacle i the number of blocks + i.
      unsigned int body = invalid_index;
      /// Along the boundary, or invalid_index.
      unsigned int previous = invalid_index, next = invalid_index;
      Corner       at_start = Corner::end, at_end = Corner::end;
      /// Map to the reference coordinates of the element's cell: xi = inverse (X - origin).
      dealii::Point<2>     origin;
      dealii::Tensor<2, 2> inverse;
      /// [m]
      double length = 0.;
      /// Curve of the physical mesh, invalid_index for obstacles.
      unsigned int curve = invalid_index;
      /// Arcs: see ElementEdge [m], and angles of start and end [rad].
      dealii::Point<2> center;
      double           first_angle = 0., last_angle = 0.;
    };

    /// Position [m] and derivatives by t [m].
    struct Place
    {
      dealii::Point<2>     x;
      dealii::Tensor<1, 2> a, b;

      /// Unit normal out of the body.
      dealii::Tensor<1, 2>
      normal() const
      {
        const double length = a.norm();
        return dealii::Point<2>(a[1] / length, -a[0] / length);
      }
    };

    /// Weight functions of the element at a place.
    struct WeightValues
    {
      unsigned int n = 0;
      double       w[WeightFunctions::max_per_cell];
    };

    /// And derivatives by t.
    struct Weights : public WeightValues
    {
      double dw[WeightFunctions::max_per_cell];
      double ddw[WeightFunctions::max_per_cell];
    };

    /// Along straight edges displacements are polynomials d[0] + d[1] t + d[2] t^2 [m].
    struct alignas(64) EdgeDisplacement
    {
      dealii::Tensor<1, 2> d[3];
    };

    /**
     * @p obstacles are numbered after the blocks. The covers of all edges are made
     * relevant to all ranks, so vectors have to be laid out afterwards.
     * @throws InputError for an obstacle whose pieces do not follow each other,
     * have no length or are full circles.
     */
    explicit ContactSurface(CoverSystem               &covers,
                            std::vector<RigidObstacle> obstacles = {});

    ContactSurface(const ContactSurface &) = delete;
    ContactSurface &
    operator=(const ContactSurface &) = delete;

    const std::vector<Edge> &
    edges() const
    {
      return all_edges;
    }

    const std::vector<RigidObstacle> &
    obstacles() const;

    const CoverSystem &
    cover_system() const;

    unsigned int
    n_bodies() const;

    bool
    is_rigid(const unsigned int edge) const
    {
      return all_edges[edge].element == invalid_index;
    }

    /// Edges of elements that this rank owns.
    std::pair<unsigned int, unsigned int>
    locally_owned_edges() const;

    /// Bodies that are not there: blocks that have left the model and obstacles that have been
    /// released. Nothing touches them, and they are in no picture. By body.
    void
    set_absent_bodies(std::vector<bool> is_absent);

    const std::vector<bool> &
    absent_bodies() const
    {
      return is_body_absent;
    }

    /// Whether the body of an edge is not there.
    bool
    is_absent(const unsigned int edge) const
    {
      return is_body_absent[all_edges[edge].body];
    }

    /// Obstacles move to where they are at @p time.
    void
    set_time(double time);

    /// Obstacles move to the mean of where they are at two times.
    void
    set_time(double time_begin, double time_end);

    /// Displacement of an obstacle at the time that was set [m].
    const dealii::Tensor<1, 2> &
    obstacle_displacement(unsigned int obstacle) const;

    /**
     * Blocks cannot overlap each other in the reference configuration, but obstacles
     * can. Of an obstacle that is not closed, what lies behind it altogether is no
     * overlap.
     * @throws InputError if a block and an obstacle overlap by more than
     * @p tolerance [m] at the time that was set, with how much and where.
     */
    void
    check_initial_overlap(double tolerance) const;

    /**
     * How deep bodies are in each other at the current displacements and time [m]: the
     * largest distance of a corner, or of an edge's middle, of a block that lies
     * inside of another one or behind an obstacle from the boundary of that
     * one. Of all blocks, whether they are in contact or not, by Boost.Geometry
     * and without anything that the contact knows: what it says can be checked by this.
     * Edges count as two chords. A corner of an obstacle in a block is not seen, nor is
     * what lies beyond the ends of an obstacle that is not closed.
     */
    double
    largest_overlap() const;

    /// Displacements: two per cover of the whole system [m]; to be called again
    /// whenever they change. Must outlive their use.
    void
    set_displacements(const std::vector<double> *nodal);

    /// What set_displacements() makes of them, to keep several of them side by side.
    struct State
    {
      std::vector<double>           nodal;
      std::vector<EdgeDisplacement> edges;
    };

    State
    state() const;

    /// The covers of an edge have moved.
    void
    update(State &state, unsigned int edge) const;

    /// As set_displacements() with its displacements. Must outlive their use.
    void
    set_state(const State &state);

    /// X(t) [m], and derivatives.
    Place
    reference_place(unsigned int edge, double t) const;

    /// x(t) at the current displacements and time.
    Place
    place(unsigned int edge, double t) const;

    /// x(t) - X(t), with the digits that positions have no room for [m].
    dealii::Tensor<1, 2>
    displacement(unsigned int edge, double t) const;

    /// Displacement along a straight edge at the current displacements and time; undefined for
    /// arcs.
    EdgeDisplacement
    edge_displacement(const unsigned int edge) const
    {
      EdgeDisplacement result;
      if (is_rigid(edge))
        result.d[0] = obstacle_displacements[all_edges[edge].body - n_blocks];
      else
        result = current[edge];
      return result;
    }

    /// Is a point surely further than @p distance [m] from all places
    /// -before <= t <= 1 + after, both at most 1/2? For straight edges; of arcs this is
    /// not known. Much less work than looking for the nearest place.
    bool
    is_further(unsigned int            edge,
               const dealii::Point<2> &x,
               double                  distance,
               double                  before,
               double                  after) const;

    void
    weights(unsigned int edge, double t, Weights &weights) const;

    /// Position of a place with given weights: less work than place().
    dealii::Point<2>
    position(unsigned int            edge,
             const dealii::Point<2> &reference,
             const Weights          &weights) const;

    /// Physical covers of the edge's element; none for obstacles.
    dealii::ArrayView<const unsigned int>
    covers(unsigned int edge) const;

    /// For people: the curve's or obstacle's name.
    std::string
    name(unsigned int edge) const;

  private:
    /// Distance from an obstacle.
    struct Nearest
    {
      /// Distance from its nearest point [m], and the same with a sign, negative behind the face.
      double distance = std::numeric_limits<double>::max();
      double gap      = 0.;
      /// The nearest point is an end of a chain that is not closed.
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
    find_displacement(unsigned int               edge,
                      const std::vector<double> &nodal,
                      EdgeDisplacement          &displacement) const;

    CoverSystem                      *cover_pointer;
    std::vector<RigidObstacle>        rigid_obstacles;
    std::vector<dealii::Tensor<1, 2>> obstacle_displacements;
    std::vector<Edge>                 all_edges;
    /// See set_absent_bodies().
    std::vector<bool> is_body_absent;
    /// First edge of each obstacle, and the number of all edges.
    std::vector<unsigned int>             obstacle_begins;
    std::pair<unsigned int, unsigned int> owned;
    unsigned int                          degree, n_blocks;
    const std::vector<double>            *nodal = nullptr;
    /// Displacements along edges of blocks, from set_displacements(), and those in use.
    std::vector<EdgeDisplacement> edge_displacements;
    const EdgeDisplacement       *current = nullptr;
    /// For the elements of straight edges, one edge after the other, at t = 0: weight functions and
    /// their first and half their second derivatives by t.
    std::vector<std::array<double, 3>> start_weights;
    std::vector<unsigned int>          start_weights_begin;
    /// Construction only: edge of an element's boundary position.
    std::vector<std::pair<std::pair<unsigned int, unsigned int>, unsigned int>>
      position_to_edge;
  };
} // namespace NMM

#endif
