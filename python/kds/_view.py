"""Pages that show runs in a browser or a notebook."""

import html
import os
import tempfile

_MOST_BYTES_IN_A_NOTEBOOK = 64_000_000  # as --max-mb of kds view


class View:
    """A page that shows a run. Made by :meth:`kds.Run.view`. Notebooks show the page in a frame.

    ``page``
        the page, a text of HTML that needs no network.
    ``path``
        the file of the page, or None.
    """

    def __init__(self, page, path=None):
        self.page = page
        self.path = path

    def __repr__(self):
        place = f" at {self.path}" if self.path else ""
        return f"<kds.View{place}, {len(self.page) / 1e6:.1f} MB>"

    def _repr_html_(self):
        if len(self.page) > _MOST_BYTES_IN_A_NOTEBOOK:
            place = (f"open {html.escape(str(self.path))} in a browser" if self.path
                     else "write it to a file with run.view(path)")
            return f"<p>The page has {len(self.page) / 1e6:.0f} MB, too many for a notebook: {place}.</p>"
        return (f'<iframe srcdoc="{html.escape(self.page)}" width="100%" height="600" style="border: 0" '
                'allowfullscreen></iframe>')


def _state(path):
    try:
        status = os.stat(path)
    except OSError:
        return None
    return status.st_size, status.st_mtime_ns


def _read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class RecordedPage:
    """A page that a run has written to a file."""

    def __init__(self, path):
        self.path = os.path.abspath(path)
        self._written = _state(self.path)

    def is_at(self, path):
        """Whether a path, or None, names the file, and the file is as the run wrote it."""
        return (path is None or os.path.abspath(path) == self.path) and _state(self.path) == self._written

    def view(self):
        return View(_read(self.path), self.path)


def view_of_new_run(write, path):
    """Returns the page that `write` writes to a path. Without a path no file is left."""
    if path is not None:
        write(os.path.abspath(path))
        return View(_read(path), os.path.abspath(path))
    with tempfile.TemporaryDirectory() as folder:
        page = os.path.join(folder, "replay.html")
        write(page)
        return View(_read(page))
