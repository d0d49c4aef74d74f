"""What the bodies of an assembly have with each other where they stand: round faces, screwed joints, touch.

Glossary
--------
round
    A cylindrical face of a body: a pin's, a bore's.
joint
    A screw, the thread that it is in, and the parts that its head clamps.
"""
