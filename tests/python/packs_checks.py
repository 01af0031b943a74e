"""Batches that are stepped in vectors against the same modules without: run by python_test.cpp."""
import unittest
from unittest import mock

import numpy as np

import cart_pole
import crane
import plain_cart_pole
import plain_crane
import plain_squeezer
import squeezer
import turned_cart_pole

PAIRS = ((cart_pole, plain_cart_pole, 1e-2), (crane, plain_crane, 1e-2), (squeezer, plain_squeezer, 1e-5))
EXPLICIT = ("euler", "semi_implicit_euler", "heun", "rk4", "rk5", "adams_bashforth2", "adams_bashforth3")


def batch(module, count, seed=1):
    """States that differ; those of loops as they start."""
    states, rng = module.Model().initial_state(count), np.random.default_rng(seed)
    if not hasattr(module.Model, "constraint_residual"):
        states.z = states.z + rng.normal(0, 0.3, states.z.shape)
    states.t = rng.uniform(0, 2, count)
    return states


class Packs(unittest.TestCase):
    def assert_same(self, left, right):
        for name in ("t", "y", "z", "failed"):
            np.testing.assert_array_equal(getattr(left, name), getattr(right, name), name)
        for name in ("t", "y", "z"):
            np.testing.assert_array_equal(getattr(left.end, name), getattr(right.end, name), name)
        self.assertEqual(list(left.outputs), list(right.outputs))
        for name, values in left.outputs.items():  # of the time as one number
            np.testing.assert_allclose(values, right.outputs[name], rtol=0, err_msg=name,
                                       atol=1e-12 * (1 + np.nanmax(abs(right.outputs[name]))))

    def in_vectors(self, module, run):
        """What runs, without scalar code."""
        with mock.patch.object(module._Run, "_scalar", side_effect=AssertionError("scalar code")):
            return run()

    def test_every_method_has_the_bits_of_scalar_code(self):
        for packed, plain, h in PAIRS:
            self.assertIsNone(plain._ensemble)
            lanes = packed._ensemble.lanes
            inputs = [0.3] * len(packed.INPUTS)
            for method in EXPLICIT:
                for count in (lanes, 3 * lanes + 1):
                    def run(module):
                        return module.Model().simulate(batch(module, count), 20 * h, h, inputs, method, every=5,
                                                       outputs=True)
                    expected = run(plain)
                    self.assertGreater(abs(expected.y[:, -1] - expected.y[:, 0]).max(), 0)
                    self.assert_same(run(packed) if "adams" in method else self.in_vectors(packed, lambda: run(packed)),
                                     expected)

    def test_turned_sines_change_last_digits(self):
        count = 2 * turned_cart_pole._ensemble.lanes
        for method in ("euler", "semi_implicit_euler", "heun", "rk4", "rk5"):
            for every in (1, 5):
                def run(module):
                    return module.Model().simulate(batch(module, count), 0.4, 1e-2, [0.3], method, every=every)
                turned, plain = self.in_vectors(turned_cart_pole, lambda: run(turned_cart_pole)), run(plain_cart_pole)
                apart = abs(turned.end.z - plain.end.z).max()
                self.assertLess(apart, 1e-12, method)
                self.assertEqual(apart > 0, "euler" not in method, method)

    def test_inputs_in_every_form_and_threads(self):
        count, steps = 3 * cart_pole._ensemble.lanes + 2, 12
        rng = np.random.default_rng(2)
        each, by_step = rng.normal(size=(count, 1)), rng.normal(size=(1, steps, 1))
        for inputs in (each, by_step, rng.normal(size=(count, steps, 1)), lambda t, y, z: -3 * y[:, 1:] - z[:, 1:]):
            for threads in (1, 2, 3):
                for every in (1, 4):
                    def run(module):
                        return module.Model(pole_mass=0.3).simulate(batch(module, count), steps * 1e-2, 1e-2, inputs,
                                                                    every=every, threads=threads)
                    self.assert_same(self.in_vectors(cart_pole, lambda: run(cart_pole)), run(plain_cart_pole))

    def test_steps_of_batches(self):
        ends = []
        for module in (crane, plain_crane):
            states, model = batch(module, 40), module.Model(rope=5)
            for _ in range(3):
                model.rk4_step(states, None, 1e-2, count=7)
            ends.append(states)
        for name in ("t", "y", "z"):
            np.testing.assert_array_equal(getattr(ends[0], name), getattr(ends[1], name))

    def test_states_that_fail_are_those_of_scalar_code(self):
        for bad in ([3], [0, 1, 2], [19], list(range(20))):
            for every in (1, 5):
                runs = []
                for module in (cart_pole, plain_cart_pole):
                    states = batch(module, 20)
                    states.z[bad] = [0, 1e150]
                    states.y[bad[0], 0] = 1e200
                    model = module.Model()
                    with self.assertRaises(module.NotFinite) as raised:
                        model.simulate(states, 1, 0.1, every=every)
                    run = model.simulate(states, 1, 0.1, every=every, failures="nan")
                    # From there on they start with what is no number.
                    again = model.simulate(run.end, 1, 0.1, every=every, failures="nan")
                    driven = model.simulate(states, 1, 0.1, lambda t, y, z: [1.0], every=every, failures="nan")
                    runs.append((str(raised.exception), run, again, driven))
                self.assertEqual(runs[0][0], runs[1][0])
                for left, right in zip(runs[0][1:], runs[1][1:]):
                    self.assertEqual(left.failed.tolist(), bad)
                    self.assert_same(left, right)

    def test_open_loops_are_those_of_scalar_code(self):
        runs = []
        for module in (squeezer, plain_squeezer):
            states, model = module.Model().initial_state(20), module.Model()
            states.y[7, 1] += 0.3
            with self.assertRaisesRegex(module.LoopsOpen, "state 7, step 0.*open at this state") as raised:
                model.simulate(states, 1e-4, 1e-5)
            runs.append((str(raised.exception), model.simulate(states, 1e-4, 1e-5, failures="nan")))
            self.assertEqual(runs[-1][1].failed.tolist(), [7])
            # Steps that no loop stands.
            with self.assertRaises(module.LoopsOpen) as raised:
                model.simulate(model.initial_state(20), 1, 0.1, method="euler")
            runs[-1] += (str(raised.exception),)
        self.assertEqual(runs[0][0], runs[1][0])
        self.assertEqual(runs[0][2], runs[1][2])
        self.assert_same(runs[0][1], runs[1][1])


if __name__ == "__main__":
    unittest.main()
