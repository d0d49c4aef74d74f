// The player of a motion: draws `data` into the page, as it stood when it was `kept`, until the `signal`.
function player(data, kept, signal) {
{% include "data.js" %}

{% include "plane.js" %}

{% include "overlays.js" %}

{% include "scripts.js" %}

{% include "plots.js" %}

{% include "export.js" %}

{% include "player.js" %}
}
