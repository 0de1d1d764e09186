"""Uses an installed module: prints the fingerprint of a small run, and the path of the module. The tests of packages run it."""

import kds

print(kds.run(kds.generate("spiral", beads=30, frames=5), radius=1).fingerprint, kds.__file__)
