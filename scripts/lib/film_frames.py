"""Frames of a film's page as an animated picture: `page FILM PAGE` makes a page that draws them, `gif FRAMES GIF`
puts what a browser has drawn into one file."""

import base64
import io
import json
import re
import sys

# The water that is shown: so many metres before the wall, and so many seconds before and after the crest.
BEFORE_WALL_M = 1.6
BEFORE_S, AFTER_S = 1.6, 1.4
# Seconds of the run from one frame to the next, and the time that each is shown, milliseconds.
STEP_S, SHOWN_MS = 0.05, 100
WIDTH, COLOURS = 720, 40

DRAW = """<script>
(() => {
  const film = JSON.parse(document.getElementById("film").textContent);
  const wall = document.getElementById("wall"), slider = document.getElementById("time");
  const crest = film.times[film.crest], out = document.createElement("pre");
  out.id = "frames";
  wall.parentNode.style.width = "%(width)dpx";
  document.getElementById("player").style.maxWidth = "none";
  for (let t = crest - %(before)f; t <= crest + %(after)f; t += %(step)f) {
    slider.value = t;
    slider.dispatchEvent(new Event("input"));
    const shot = document.createElement("canvas");
    shot.width = wall.width;
    shot.height = wall.height;
    const pen = shot.getContext("2d");
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, shot.width, shot.height);
    pen.drawImage(wall, 0, 0);
    pen.fillStyle = "#222";
    pen.font = "16px sans-serif";
    pen.fillText("t = " + t.toFixed(2) + " s", 12, 24);
    out.textContent += shot.toDataURL("image/png") + "\\n";
  }
  document.body.append(out);
})();
</script>
"""


def page(film: str, out: str) -> None:
    """The film's page with more of the water before the wall, and a script that draws all frames."""
    with open(film, encoding="utf-8") as file:
        text = file.read()
    mark = re.compile(r'(<script type="application/json" id="film">)(.*?)(</script>)', re.DOTALL)
    found = mark.search(text)
    if found is None:
        sys.exit(f"{film}: no film in it")
    data = json.loads(found[2])
    beyond = data["near"]["width"] - data["near"]["x"]
    data["near"] = {"x": BEFORE_WALL_M, "width": BEFORE_WALL_M + beyond}
    text = text[: found.start(2)] + json.dumps(data) + text[found.end(2) :]
    draw = DRAW % {"width": WIDTH, "before": BEFORE_S, "after": AFTER_S, "step": STEP_S}
    with open(out, "w", encoding="utf-8") as file:
        file.write(text.replace("</body>", draw + "</body>"))


def gif(frames: str, out: str) -> None:
    """All frames in one file, with one palette."""
    from PIL import Image

    with open(frames, encoding="utf-8") as file:
        shots = re.findall(r"data:image/png;base64,([A-Za-z0-9+/=]+)", file.read())
    if not shots:
        sys.exit("the browser has drawn no frame")
    images = [Image.open(io.BytesIO(base64.b64decode(shot))).convert("RGB") for shot in shots]
    palette = images[len(images) // 2].quantize(COLOURS, dither=Image.Dither.NONE)
    images = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    images[0].save(out, save_all=True, append_images=images[1:], duration=SHOWN_MS, loop=0, optimize=True)


if __name__ == "__main__":
    {"page": page, "gif": gif}[sys.argv[1]](*sys.argv[2:])
