#ifndef nmm_mechanics_joint_water_term_h
#define nmm_mechanics_joint_water_term_h

#include <nmm/mechanics/force_term.h>
#include <nmm/mechanics/joint_flow.h>
#include <nmm/mechanics/solid.h>
#include <nmm/mechanics/water.h>

#include <array>
#include <string>
#include <vector>

namespace NMM
{
  /// Water that flows in the network of all open joints of a solid.
  struct JointWater
  {
    /// The table, whose elevation is the head at outer boundaries below it.
    WaterTable table;
    /// Dynamic viscosity [Pa s].
    double viscosity = 1e-3;
    /// Aperture of a joint whose faces touch without effective stress [m].
    double aperture = 0.;
    /// Least and largest aperture for the flow [m].
    double residual_aperture = 0., largest_aperture = 0.;
    /// Names of boundaries and holes through which nothing flows.
    std::vector<std::string> impermeable;
    /// Factor of the pressure that acts on faces, a function of time or load factor; empty: 1.
    std::function<double(double)> amplitude = nullptr;

    /// Checks all values. @throws InputError naming the value.
    void
    check() const;
  };


  /**
   * The pressure of water that flows steadily through open joints and cracks (FlowNetwork), on both
   * of their faces. Links of the network are the edges of manifold elements on joints, and their ends
   * its nodes. The aperture at an end of a link is
   * @f[ b = \min(b_{max}, \max(b_{res}, b_0 + [u]\cdot n)), @f]
   * where [u] n is the opening of both faces that were opposite to each other in the drawing, negative
   * where contact is closed and presses. So closure by the effective normal stress is that of the
   * contact law.
   *
   * Heads: at outer boundaries below the table, its elevation; at boundaries and holes above it, and
   * at all holes, the air (FlowNetwork::Node::is_in_air); nothing flows through impermeable ones, nor
   * at ends of joints in blocks. Where the block on one side of a link is gone, the joint is open to
   * the air: the link is left out, and its nodes are faces in the air.
   *
   * Staggered: the flow is computed at the beginning of each step with the apertures there, and its
   * pressures are kept during the step. change() tells how much they have changed by that. A relaxation
   * ends where both agree; load steps have to be repeated until they do. Motion is that of slow flow.
   * Forces are along the normals of the drawing: for small displacements.
   */
  class JointWaterTerm : public ForceTerm
  {
  public:
    /// @throws InputError for a joint whose faces are not cut by the same triangles.
    JointWaterTerm(const Solid       &solid,
                   const ModelLayout &layout,
                   JointWater         water);

    void
    begin_step(const StepBegin &step) override;

    Deformation
    assemble(const Trial &trial, AssembledForces &sum) override;

    ForceProperties
    properties() const override
    {
      return {};
    }

    StepWork
    commit(const Trial &step) override;

    void
    set_presence(const Presence &presence) override;

    /// @{
    /// The network with its present apertures, the flow in it, and positions of its nodes [m].
    const FlowNetwork &
    network() const
    {
      return present;
    }

    const NetworkFlow &
    flow() const
    {
      return found;
    }

    const std::vector<dealii::Point<2>> &
    positions() const
    {
      return nodes;
    }
    /// @}

    /// Joint of each link, the name of its curve.
    const std::vector<std::string> &
    joints() const
    {
      return names;
    }

    /// Pressure at a node [Pa].
    double
    pressure(unsigned int node) const;

    /// Largest change of the pressure at a node by the last solution [Pa].
    double
    change() const
    {
      return last_change;
    }

    /// Computes the flow for the displacements @p u, of which relevant unknowns are needed [m].
    /// Collective.
    void
    update(const Vector &u);

  private:
    /// An edge on a joint, with the blocks on both sides, whether both are there or not.
    struct Edge
    {
      FlowNetwork::Link         link;
      std::string               joint;
      std::vector<unsigned int> blocks = {};
    };

    /// An owned face of an edge.
    struct Face
    {
      unsigned int edge, element;
      /// Weight functions at both ends of the link times the outward normal there, and their
      /// integrals over the face with the pressure's linear functions of both ends.
      std::array<std::vector<dealii::Tensor<1, 2>>, 2> at_ends, integrals;
    };

    const CoverSystem            *covers;
    const ModelLayout            *layout;
    JointWater                    water;
    FlowNetwork                   present;
    NetworkFlow                   found;
    std::vector<dealii::Point<2>> nodes;
    std::vector<std::string>      names;
    std::vector<Edge>             edges;
    /// Link of each edge; invalid_index if a block beside it is gone.
    std::vector<unsigned int> link_of_edge;
    std::vector<bool>         absent_blocks;
    /// Nodes at outer faces in the air.
    std::vector<bool> is_in_air;
    std::vector<Face> faces;
    Vector            force;
    double            last_change = 0.;

    void
    find_links(const Solid &solid);

    void
    add_face(unsigned int       number,
             unsigned int       element,
             const ElementEdge &edge);

    /// Makes links of all edges whose blocks are there.
    void
    set_links();

    /// Sets `force` by the pressures of the last flow. Collective.
    void
    assemble_force();

    void
    set_heads(const Solid &solid);

    double
    amplitude(double t) const;
  };
} // namespace NMM

#endif
