"""Planar mechanisms of uniform rods of 1 m and 1 kg in Exudyn: double pendulum and rows of four-bars."""
import math

import exudyn as exu
from exudyn.utilities import (LoadMassProportional, MarkerBodyMass, MarkerBodyPosition, NodeRigidBody2D,
                              ObjectGround, ObjectJointRevolute2D, ObjectRigidBody2D, SensorNode)

GRAVITY = 9.81


class Mechanism:
    """A system with its nodes; with sensors, coordinates and velocities of all nodes are kept."""

    def __init__(self, sensors):
        self.container = exu.SystemContainer()
        self.mbs = self.container.AddSystem()
        self.ground = self.mbs.AddObject(ObjectGround())
        self.sensors = [] if sensors else None
        self.nodes, self.starts = [], []

    def rod(self, x, y, angle, velocity=(0, 0, 0)):
        """A rod whose centre is at (x, y) m."""
        node = self.mbs.AddNode(NodeRigidBody2D(referenceCoordinates=[x, y, angle], initialVelocities=list(velocity)))
        body = self.mbs.AddObject(ObjectRigidBody2D(mass=1, inertia=1 / 12, nodeNumber=node))
        marker = self.mbs.AddMarker(MarkerBodyMass(bodyNumber=body))
        self.mbs.AddLoad(LoadMassProportional(markerNumber=marker, loadVector=[0, -GRAVITY, 0]))
        self.nodes.append(node)
        self.starts.append((x, y, angle))
        if self.sensors is not None:
            kinds = (exu.OutputVariableType.Coordinates, exu.OutputVariableType.Coordinates_t)
            self.sensors.append([self.mbs.AddSensor(SensorNode(
                nodeNumber=node, outputVariableType=kind, storeInternal=True, writeToFile=False)) for kind in kinds])
        return body

    def pin(self, first, at_first, second, at_second):
        """A revolute joint between two bodies, at points in their own frames."""
        markers = [self.mbs.AddMarker(MarkerBodyPosition(bodyNumber=body, localPosition=[*at, 0]))
                   for body, at in ((first, at_first), (second, at_second))]
        self.mbs.AddObject(ObjectJointRevolute2D(markerNumbers=markers))


def double_pendulum(sensors):
    """Two rods, let go from the horizontal."""
    m = Mechanism(sensors)
    upper, lower = m.rod(0.5, 0, 0), m.rod(1.5, 0, 0)
    m.pin(m.ground, (0, 0), upper, (-0.5, 0))
    m.pin(upper, (0.5, 0), lower, (-0.5, 0))
    return m


def four_bars(n, sensors):
    """Cranks up on pivots 1 m apart, couplers between their tips, which move at 1 m/s in x."""
    m = Mechanism(sensors)
    cranks = [m.rod(j, 0.5, math.pi / 2, (0.5, 0, -1)) for j in range(n + 1)]
    for j, crank in enumerate(cranks):
        m.pin(m.ground, (j, 0), crank, (-0.5, 0))
    for i in range(n):
        coupler = m.rod(i + 0.5, 1, 0, (1, 0, 0))
        m.pin(cranks[i], (0.5, 0), coupler, (-0.5, 0))
        m.pin(cranks[i + 1], (0.5, 0), coupler, (0.5, 0))
    return m
