"""Parameters of order 1 <-> the motion of a rig and the signals that a recording of it would have."""

import numpy as np

from ..arrays import Mask, Reals
from .contact_pulse import identified
from .first_guess import Guess
from .recording import Recording
from .release_motion import Motion, Rig, motion

SHARP = ("force", "acceleration")  # signals that jump at first touch
FIRST_DAMPING_RATIO = 0.005
FIRST_RESTITUTION = 0.4
LEAST_NOISE = 1e-6  # of a signal's range
STIFFNESS, DAMPING, TOUCH, SPEED, OMEGA, DAMPING_RATIO, OFFSETS = range(7)  # places of the parameters; an offset of each signal


class Model:
    """Of a Recording, its Guess, a mass [kg], a gap [m], and (omega, damping ratio) of the springs where they are given.

    Parameters are ln ki and ci over their first guess, the first touch in contacts from its guess, ln of its speed and of omega
    over what start() took, the damping ratio, and the signals' offsets in their ranges."""

    def __init__(self, recording: Recording, guess: Guess, mass: float, gap: float,
                 springs: tuple[float, float] | None) -> None:
        self.recording, self.guess, self.mass, self.gap = recording, guess, mass, gap
        self.springs = springs  # (omega, damping ratio) where they are given, or None
        self.names = list(recording.signals)
        self.ranges = {name: float(np.ptp(values)) for name, values in recording.signals.items()}
        self.noise = {name: max(guess.noise[name], LEAST_NOISE * self.ranges[name]) for name in self.names}
        self.first = identified(mass, FIRST_RESTITUTION, guess.contact_s)
        self.speed, self.omega = 1.0, 1.0  # of which the parameters are multiples

    def start(self, omega: float) -> Reals:
        """The first parameters, with springs of this omega [rad/s]."""
        self.omega, self.speed = omega, 1.0
        parameters = np.array([0, 1, 0, 0, 0, FIRST_DAMPING_RATIO, *[0] * len(self.names)], dtype=float)
        self.speed = self._first_speed(parameters)
        return parameters

    def rig(self, parameters: Reals) -> Rig:
        """That of these parameters."""
        omega, ratio = self.springs or (self.omega * np.exp(parameters[OMEGA]), parameters[DAMPING_RATIO])
        return Rig(self.mass, self.first[0] * np.exp(parameters[STIFFNESS]), self.first[1] * parameters[DAMPING], omega, ratio, self.gap)

    def motion(self, parameters: Reals, until: float) -> Motion:
        """That of these parameters, with all impacts that begin before `until` [s]."""
        touch = self.guess.touch_time + parameters[TOUCH] * self.guess.contact_s
        return motion(self.rig(parameters), touch, self.speed * np.exp(parameters[SPEED]), until)

    def signals(self, moved: Motion, parameters: Reals, time: Reals) -> dict[str, Reals]:
        """As recorded."""
        model = moved.signals(time, self.names)
        return {name: self.guess.signs[name] * model[name] + self.guess.offsets[name] + self.ranges[name] * offset
                for name, offset in zip(self.names, parameters[OFFSETS:])}

    def free(self, springs: bool) -> Mask:
        """Which of the parameters are fitted."""
        return np.array([True] * 4 + [springs and not self.springs] * 2 + [True] * len(self.names))

    def _first_speed(self, parameters):
        """At which the first impact is as strong as the recorded one; of a displacement, with which its swing is as wide."""
        sharp = [name for name in SHARP if name in self.names]
        name = (sharp or self.names)[0]
        begin = self.guess.touch_time
        end = begin + 1.5 * self.guess.contact_s if sharp else self.recording.time[-1]
        inside = (self.recording.time >= begin) & (self.recording.time <= end)
        values = self.recording.signals[name][inside] - self.guess.offsets[name]
        model = self.motion(parameters, begin).signals(self.recording.time[inside], [name])[name]
        return float(np.max(np.abs(values)) / np.max(np.abs(model)))
