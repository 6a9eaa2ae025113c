// How the editor of packs is put together: keys, gutters, colours, folding, completion.
import {autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap} from '@codemirror/autocomplete';
import {defaultKeymap, history, historyKeymap, indentWithTab} from '@codemirror/commands';
import {
  bracketMatching, codeFolding, foldGutter, foldKeymap, HighlightStyle, indentOnInput, indentUnit, syntaxHighlighting
} from '@codemirror/language';
import {lintGutter, lintKeymap} from '@codemirror/lint';
import {highlightSelectionMatches, search, searchKeymap} from '@codemirror/search';
import {EditorState, type Extension} from '@codemirror/state';
import {
  drawSelection, dropCursor, EditorView, highlightActiveLine, highlightActiveLineGutter, highlightSpecialChars, keymap, lineNumbers,
  rectangularSelection
} from '@codemirror/view';
import {tags} from '@lezer/highlight';

import type {Source} from '../source';
import {words} from '../strings';
import {completionSource, hoverSource} from './assistance';
import {packSupport} from './pack_language';

// The colours are names of classes: editor.css has them, for dark and light.
const colours = HighlightStyle.define([
  {tag: [tags.definition(tags.propertyName), tags.propertyName], class: 'tok-key'},
  {tag: [tags.operator, tags.punctuation, tags.separator, tags.squareBracket, tags.brace], class: 'tok-quiet'},
  {tag: [tags.lineComment, tags.comment], class: 'tok-comment'},
  {tag: [tags.string, tags.content], class: 'tok-text'}
]);

/** The nonce of the page's own script: style elements of the editor need it under the page's Content-Security-Policy. */
export function withNonce(): Extension {
  return EditorView.cspNonce.of(document.querySelector<HTMLElement>('script[nonce], style[nonce]')?.nonce ?? '');
}

/** Long lines are broken where there is no room to scroll to their end. */
function wrapping(): Extension {
  return matchMedia('(max-width: 759px)').matches ? EditorView.lineWrapping : [];
}

/** What every view of a pack has, also the read-only ones. */
export function packLook(): Extension {
  return [
    withNonce(), wrapping(), packSupport(), syntaxHighlighting(colours), lineNumbers(), highlightSpecialChars(),
    EditorState.tabSize.of(2), indentUnit.of('  ')
  ];
}

function folding(): Extension {
  return [
    codeFolding({placeholderText: '…'}),
    foldGutter({
      markerDOM: isOpen => {
        const marker = document.createElement('span');
        marker.className = isOpen ? 'fold is-open' : 'fold';
        marker.setAttribute('aria-hidden', 'true');
        return marker;
      }
    })
  ];
}

export function packEditing(source: Source): Extension {
  return [
    packLook(), history({newGroupDelay: 600}), folding(), lintGutter(), drawSelection(), dropCursor(), rectangularSelection(),
    EditorState.allowMultipleSelections.of(true), indentOnInput(), bracketMatching(), closeBrackets(), highlightActiveLine(),
    highlightActiveLineGutter(), highlightSelectionMatches(), search({top: true}),
    autocompletion({override: [completionSource(source)], activateOnTypingDelay: 60, maxRenderedOptions: 60, icons: false}),
    hoverSource(source), EditorView.contentAttributes.of({'aria-label': words.editor.name, spellcheck: 'false'}),
    EditorState.phrases.of(words.editor.phrases),
    keymap.of([
      ...closeBracketsKeymap, ...completionKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...foldKeymap, ...lintKeymap,
      indentWithTab
    ])
  ];
}
