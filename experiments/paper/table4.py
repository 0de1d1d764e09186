"""Table 4: detecting self-collision while the necklace deforms.

Measured as table 3. The paper does not say which frames its rows show.
"""

from table3 import self_collision

self_collision(4, __doc__).finish()
