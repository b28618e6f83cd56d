#ifndef nmm_mechanics_joint_flow_h
#define nmm_mechanics_joint_flow_h

#include <optional>
#include <vector>

namespace NMM
{
  /**
   * A network of joints in which water flows: nodes, and links between them. The flow in a link of the
   * aperture b and the length L obeys the cubic law of laminar flow between parallel walls,
   * @f[ q = \frac{\gamma_w}{12\mu}\,\Big(\frac1L\int_0^L b^{-3}\,ds\Big)^{-1}\,\frac{h_1-h_2}{L}, @f]
   * per unit thickness [m^2/s], with the unit weight gamma_w and the viscosity mu of water and the
   * heads h = y + p / gamma_w [m] of its ends. For an aperture that is linear along the link the mean
   * of b^{-3} is (b_1 + b_2) / (2 b_1^2 b_2^2). Joints are full of water, also above the line where
   * p = 0; it neither has inertia nor is it stored.
   */
  struct FlowNetwork
  {
    struct Node
    {
      /// Elevation y [m].
      double elevation = 0.;
      /// Given head [m], if any.
      std::optional<double> head = std::nullopt;
      /// Whether the node is at a face in the air, where water flows out at the pressure 0, but none
      /// comes in. Not used for a node with a given head.
      bool is_in_air = false;
    };

    struct Link
    {
      /// Nodes at its ends.
      unsigned int nodes[2];
      /// Length L [m].
      double length;
      /// Apertures b at its ends [m].
      double apertures[2];
    };

    std::vector<Node> nodes;
    std::vector<Link> links;
    /// Unit weight gamma_w [N/m^3].
    double unit_weight = 9810.;
    /// Dynamic viscosity mu [Pa s].
    double viscosity = 1e-3;

    /// Flow of a link over the difference of its heads [m/s].
    double
    conductance(const Link &link) const;
  };


  /// Steady flow in a network.
  struct NetworkFlow
  {
    /// Head of each node [m]; its elevation, which means the pressure 0, where no given head can be
    /// felt.
    std::vector<double> heads;
    /// Flow of each link from its first to its second node [m^2/s].
    std::vector<double> flows;
    /// Flow into the network at each node [m^2/s]; 0 within rounding at inner nodes.
    std::vector<double> inflows;
    /// Number of nodes that are connected with no given head and no face in the air.
    unsigned int n_dry = 0;
  };


  /**
   * The steady flow in @p network: at each node without a given head, what flows in flows out. At a
   * face in the air either water flows out and the pressure is 0, or there is no flow and the pressure
   * is not positive (Signorini's condition); which of both is found by iterations. Direct solution of a
   * sparse symmetric system for each of them.
   * @throws NumericalFailure if the faces at which water flows out are not found, or the system is
   * singular to rounding.
   */
  NetworkFlow
  solve_flow(const FlowNetwork &network);
} // namespace NMM

#endif
